#!/usr/bin/env python3
"""Bed files: the positions that every code of the comparison starts from.

A bed file is text in metres: `width depth height` of the box, then one line `x y z radius` for each grain.

    bed.py scatter COUNT BED [--fill H]   random grains without overlap in a box of 10 x 10 x 40 diameters per 1,000
                                          grains, scaled with their number; H: only up to this many diameters
    bed.py settled DUMP START BED         positions of a LAMMPS dump in the box of START
    bed.py tile BED TALL                  2 x 2 copies side by side, 2 1/2 on top of each other
    bed.py data BED DATA                  the data file that LAMMPS and LIGGGHTS read
"""
import argparse
import contextlib
import itertools
import math
import os
import random

DIAMETER = 250e-6  # m
DENSITY = 2460.0  # kg/m3


def read(path):
    with open(path) as lines:
        box = tuple(map(float, next(lines).split()))
        return box, [tuple(map(float, line.split())) for line in lines]


@contextlib.contextmanager
def whole(path):
    """A file to write that appears under its name only when all of it is there."""
    with open(path + ".new", "w") as out:
        yield out
    os.replace(path + ".new", path)


def write(path, box, grains):
    with whole(path) as out:
        for numbers in (box, *grains):
            out.write(" ".join(f"{number:.12e}" for number in numbers) + "\n")


def scatter(count, path, fill):
    """Random sequential insertion: a place is drawn until the grain touches none of those before."""
    width = 10.0 * (count / 1000.0) ** (1.0 / 3.0)
    top = fill or 4.0 * width
    draw = random.Random(1)
    cells, places = {}, []
    around = list(itertools.product((-1, 0, 1), repeat=3))
    for _ in range(1000 * count):
        if len(places) == count:
            break
        place = [0.5 + draw.random() * (side - 1.0) for side in (width, width, top)]
        cell = [math.floor(coordinate) for coordinate in place]
        near = (cells.get(tuple(c + step for c, step in zip(cell, steps)), ()) for steps in around)
        if all(math.dist(place, other) > 1.0001 for other in itertools.chain.from_iterable(near)):
            cells.setdefault(tuple(cell), []).append(place)
            places.append(place)
    else:
        raise SystemExit(f"no room for {count} grains below {top:g} diameters")
    box = (width * DIAMETER, width * DIAMETER, 4.0 * width * DIAMETER)
    write(path, box, [(*(c * DIAMETER for c in place), DIAMETER / 2.0) for place in places])


def settled(dump, start, path):
    box, begun = read(start)
    with open(dump) as lines:
        for line in lines:
            if line.startswith("ITEM: ATOMS"):
                break
        places = [tuple(map(float, line.split())) for line in lines]
    inside = all(0.0 < c < side for place in places for c, side in zip(place, box))
    if len(places) != len(begun) or not inside:
        raise SystemExit(f"{dump}: grains left the box while settling ({len(places)} of {len(begun)} kept)")
    write(path, box, [(*place, DIAMETER / 2.0) for place in places])


def tile(low, path):
    (width, depth, height), grains = read(low)
    grains.sort(key=lambda grain: grain[2])
    top = grains[-1][2] + grains[-1][3]
    layers = (grains, grains, grains[: len(grains) // 2])
    tall = [
        (x + i * width, y + j * depth, z + level * top, radius)
        for level, layer in enumerate(layers)
        for i, j in itertools.product((0, 1), repeat=2)
        for x, y, z, radius in layer
    ]
    write(path, (2.0 * width, 2.0 * depth, 2.0 * height), tall)


def data(bed, path):
    box, grains = read(bed)
    with whole(path) as out:
        out.write(f"grains\n\n{len(grains)} atoms\n1 atom types\n\n")
        for axis, side in zip("xyz", box):
            out.write(f"0 {side:.12e} {axis}lo {axis}hi\n")
        out.write("\nAtoms\n\n")
        for number, (x, y, z, radius) in enumerate(grains, 1):
            out.write(f"{number} 1 {2.0 * radius:.12e} {DENSITY:g} {x:.12e} {y:.12e} {z:.12e}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    command = commands.add_parser("scatter")
    command.add_argument("count", type=int)
    command.add_argument("path")
    command.add_argument("--fill", type=float)
    for name, arguments in (("settled", ("dump", "start", "path")), ("tile", ("low", "path")), ("data", ("bed", "path"))):
        command = commands.add_parser(name)
        for argument in arguments:
            command.add_argument(argument)
    chosen = vars(parser.parse_args())
    {"scatter": scatter, "settled": settled, "tile": tile, "data": data}[chosen.pop("command")](**chosen)


if __name__ == "__main__":
    main()
