#!/usr/bin/env python3
"""Particle-steps per second of each code on the same positions, one core; called by peers.sh.

A peer's time is the user CPU of a run with its warm-up and the timed steps less that of a run of the warm-up alone, so
that starting, reading and the first neighbour list do not count. Ours is what the benchmark `beds` prints of itself.
The codes take turns, and the median of the repeats counts. Lines:

    PEER  <code> <case> <particle-steps/s> [<least>..<most>] <contacts per grain>
    OURS  <with rolling|without> <case> <particle-steps/s> [<least>..<most>]
    RATIO <peer> <case> <ours/theirs>
    GROWTH <code> <cost of a particle-step at 100,000 grains over that at 1,000, settled bed>
"""
import argparse
import math
import os
import re
import statistics
import subprocess
import sys
from typing import NamedTuple

HERE = os.path.dirname(os.path.abspath(__file__))
DIAMETER, DENSITY = 250e-6, 2460.0  # m, kg/m3
LIQUID_DENSITY, VISCOSITY = 1005.1, 1e-3  # kg/m3, Pa s
# Of grains of one density, buoyancy is a share of the weight, and Stokes' drag is one factor on the velocity.
GRAVITY = 9.81 * (1.0 - LIQUID_DENSITY / DENSITY)  # m/s2
DRAG = 3.0 * math.pi * VISCOSITY * DIAMETER  # kg/s


class Case(NamedTuple):
    start: str  # bed file
    skin: float  # of a peer's neighbour list, over the diameter
    warm: int  # steps of a peer before the timed ones: the bed comes to rest in that peer's law
    steps: int
    peers: tuple


CASES = {
    "bed_1000": Case("bed_1000", 0.05, 500, 10_000, ("lammps", "liggghts")),
    "bed_10000": Case("bed_10000", 0.05, 300, 1_500, ("lammps", "liggghts")),
    "bed_100000": Case("bed_100000", 0.05, 100, 200, ("lammps", "liggghts")),
    "dilute_1000": Case("start_1000", 0.3, 0, 5_000, ("liggghts",)),
    "dilute_10000": Case("start_10000", 0.3, 0, 2_000, ("liggghts",)),
    "dilute_100000": Case("start_100000", 0.3, 0, 500, ("liggghts",)),
}
# Like is compared with like: ours with rolling resistance beside LIGGGHTS, without beside LAMMPS.
LAW = {"liggghts": "--rolling", "lammps": "--no-rolling"}


class Unusable(Exception):
    """A run whose figure must not be used, with the reason."""


def bed_file(folder, name, ending=".txt"):
    return os.path.join(folder, name + ending)


def box_and_count(path):
    with open(path) as lines:
        box = next(lines).split()
        return box, sum(1 for line in lines if line.strip())


def user_seconds(command, environment):
    """User CPU seconds of a command with its children, and what it printed."""
    child = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    printed = child.stdout.read()
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode:
        raise Unusable(f"{command[0]} ended with {child.returncode}:\n{printed[-1500:]}")
    return usage.ru_utime, printed


def peer_command(peer, case, options, steps):
    box, _ = box_and_count(bed_file(options.folder, case.start))
    variables = {"data": bed_file(options.folder, case.start, ".data"), "steps": steps, "skin": case.skin * DIAMETER,
                 "gravity": GRAVITY, "drag": DRAG}
    if peer == "liggghts":
        variables.update(zip(("width", "depth", "height"), box))
    command = [os.path.join(options.folder, peer), "-in", os.path.join(HERE, f"bed.{peer}"), "-log", "none"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    return ["taskset", "-c", str(options.core)] + command


def last_row(printed):
    """Grains and contacts per grain in the last row that a peer printed of its state."""
    rows = re.findall(r"^\s*\d+\s+(\d+)\s+([-+.\deE]+)(?:\s|$)", printed, re.MULTILINE)
    if not rows:
        raise Unusable(f"no state in the output:\n{printed[-1500:]}")
    return int(rows[-1][0]), float(rows[-1][1])


def peer_rate(peer, case, options):
    """Particle-steps per second and contacts per grain of one measurement."""
    _, count = box_and_count(bed_file(options.folder, case.start))
    warm, _ = user_seconds(peer_command(peer, case, options, case.warm), os.environ)
    whole, printed = user_seconds(peer_command(peer, case, options, case.warm + case.steps), os.environ)
    left, contacts = last_row(printed)
    if left != count:
        raise Unusable(f"{peer} lost {count - left} of {count} grains")
    if whole - warm <= 0.1:
        raise Unusable(f"{peer}: {whole - warm:.2f} s of CPU are too few to tell a speed")
    return count * case.steps / (whole - warm), contacts


def our_command(*arguments):
    return ["cargo", "bench", "--quiet", "-p", "kynch-sim", "--bench", "beds", *arguments]


def our_rate(law, case, options):
    command = our_command("--", bed_file(options.folder, case.start), "--walls", "--steps", str(case.steps), law)
    _, printed = user_seconds(["taskset", "-c", str(options.core), *command], os.environ)
    found = re.search(r"^BENCH\s+bed_\d+\s+([-+.\deE]+)\s+particle-steps/s", printed, re.MULTILINE)
    if not found or not float(found.group(1)) > 0.0:
        raise Unusable(f"the benchmark printed no speed:\n{printed[-1500:]}")
    return float(found.group(1))


def why_ours_is_missing():
    """Builds our benchmark; the compiler's last words where that fails."""
    try:
        built = subprocess.run(our_command("--no-run"), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    except OSError as error:
        return str(error)
    return built.stdout.strip()[-1500:] if built.returncode else None


class Table:
    """Every rate by (code, case); a code that fails in a case is left out of it, and its reason told once."""

    def __init__(self):
        self.rates, self.contacts, self.failed = {}, {}, {}

    def add(self, code, case, measure):
        if (code, case) in self.failed:
            return
        try:
            rate = measure()
        except Unusable as reason:
            self.failed[code, case] = str(reason)
            print(f"MISSING {code} {case}: {reason}", flush=True)
            return
        if isinstance(rate, tuple):
            rate, self.contacts[code, case] = rate
        self.rates.setdefault((code, case), []).append(rate)

    def median(self, code, case):
        if (code, case) in self.failed or (code, case) not in self.rates:
            return None
        return statistics.median(self.rates[code, case])

    def show(self, code, case):
        median = self.median(code, case)
        if median is None:
            return
        rates = self.rates[code, case]
        line = f"{case} {median:.3e} [{min(rates):.3e}..{max(rates):.3e}]"
        if (code, case) in self.contacts:
            print(f"PEER {code} {line} {self.contacts[code, case]:.2f} contacts")
        else:
            print(f"OURS {'with rolling' if code == '--rolling' else 'without'} {line}")

    def growth(self, code, name):
        few, many = self.median(code, "bed_1000"), self.median(code, "bed_100000")
        if few and many:
            print(f"GROWTH {name} {few / many:.2f}")


def measure(name, table, options, ours):
    """One case: all codes in turn, as often as asked, and its lines."""
    case = CASES[name]
    if not all(os.path.exists(bed_file(options.folder, case.start, ending)) for ending in (".txt", ".data")):
        print(f"MISSING {name}: no positions {case.start}")
        return
    peers = [peer for peer in case.peers if os.access(os.path.join(options.folder, peer), os.X_OK)]
    for _ in range(options.repeats):
        for peer in peers:
            table.add(peer, name, lambda: peer_rate(peer, case, options))
            if ours:
                table.add(LAW[peer], name, lambda: our_rate(LAW[peer], case, options))
    for peer in peers:
        table.show(peer, name)
        table.show(LAW[peer], name)
    for peer in peers:
        mine, theirs = table.median(LAW[peer], name), table.median(peer, name)
        if mine and theirs:
            print(f"RATIO {peer} {name} {mine / theirs:.2f}")
    print(f"load {os.getloadavg()[0]:.2f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="where the peers and the bed files are")
    parser.add_argument("--core", type=int, required=True)
    parser.add_argument("--repeats", type=int, required=True)
    parser.add_argument("--without-ours", action="store_true")
    parser.add_argument("cases", nargs="*", metavar="CASE", default=list(CASES))
    options = parser.parse_intermixed_args()
    unknown = [name for name in options.cases if name not in CASES]
    if unknown:
        parser.error(f"no case {', '.join(unknown)}; there are {', '.join(CASES)}")
    missing = "not asked for" if options.without_ours else why_ours_is_missing()
    if missing:
        print(f"MISSING ours: no RATIO lines; {missing}", flush=True)
    table = Table()
    for name in options.cases:
        measure(name, table, options, ours=not missing)
    for code, name in (("lammps", "lammps"), ("liggghts", "liggghts"), ("--no-rolling", "ours, without"),
                       ("--rolling", "ours, with rolling")):
        table.growth(code, name)
    complete = all(table.median(peer, name) and (options.without_ours or table.median(LAW[peer], name))
                   for name in options.cases for peer in CASES[name].peers)
    sys.exit(0 if complete else 1)


if __name__ == "__main__":
    main()
