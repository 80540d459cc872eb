# Every recipe calls the same cargo command that the README names.

# what there is
default:
    @just --list

# run what is missing of a study, judge it, write its report
study +names:
    cargo study {{names}}

# every point of a study: cached or due, with its physics and cost
plan name:
    cargo kynch plan {{name}}

# judge and write the report from the store alone
report +names:
    cargo kynch report {{names}}

# all tests of both crates
test:
    cargo test --workspace

# check every file of the store
verify store="store":
    cargo kynch verify --store {{store}}

# speed of the simulator: lines `BENCH <name> <value> <unit>`
bench:
    cargo bench -p kynch-sim --bench '*'

# speed of beds beside LAMMPS and LIGGGHTS, which it installs into target/peers
peers *cases:
    benches/peers.sh {{cases}}

# format the sources
fmt:
    cargo fmt --all

# format and lints, warnings denied
lint:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets -- -D warnings

# everything that must hold before a change is taken
ci:
    .ci/run
