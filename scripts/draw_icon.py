"""Draw the icon of the tool that edits bricks, in the form in which Blender keeps its own.

::

    python3 scripts/draw_icon.py            write legorize_addon/ui/icons/edit_bricks.dat
    python3 scripts/draw_icon.py --check    end with 1 if it is out of date

A file of Blender's tool icons is a header, then the corners of triangles in a
square of 255, y upwards, then the colour of each corner (``BKE_icons.h``,
``Icon_Geom``). Later triangles lie over earlier ones.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Final

FILE: Final = Path(__file__).resolve().parents[1] / "legorize_addon" / "ui" / "icons" / "edit_bricks.dat"

Point = tuple[float, float]
Grey = tuple[int, int, int]

FRONT: Final = (110.0, 34.0)
"""Lowest corner of the brick."""

RIGHT, LEFT, UP = (52.0, 26.0), (-52.0, 26.0), (0.0, 62.0)
"""A stud along each side, and the height, in the picture."""

STUD: Final = (31.0, 15.5)
STUD_HEIGHT: Final = 24.0
SIDES: Final = 16

PALE, MIDDLE, DARK = (229, 229, 229), (178, 178, 178), (130, 130, 130)
"""Top, right and left; the first one is the grey of Blender's own icons."""

PICKED: Final = (255, 150, 30), (200, 105, 0)
"""Top and side of the stud that is picked, in the colour of what is selected."""


def main() -> int:
    """Write the icon, or compare it."""
    parser = argparse.ArgumentParser(description="Draw the icon of the tool Edit Bricks.")
    parser.add_argument("--check", action="store_true", help="end with 1 if the file is out of date")
    if parser.parse_args().check:
        return int(FILE.read_bytes() != icon())
    FILE.parent.mkdir(exist_ok=True)
    FILE.write_bytes(icon())
    return 0


def icon() -> bytes:
    """Return the file: a brick of two studs, the front one picked."""
    corners, colours = bytearray(), bytearray()
    for polygon, colour in shapes():
        for second, third in pairwise(polygon[1:]):
            for x, y in (polygon[0], second, third):
                corners += bytes((round(x), round(y)))
                colours += bytes((*colour, 255))
    return b"VCO\x00" + bytes((255, 255, 0, 0)) + bytes(corners) + bytes(colours)


def shapes() -> Iterator[tuple[Sequence[Point], Grey]]:
    """Yield convex polygons and their colours, those behind first."""
    right, back, left = at(2, 0, 0), at(2, 1, 0), at(0, 1, 0)
    yield (FRONT, right, raised(right), raised(FRONT)), MIDDLE
    yield (FRONT, left, raised(left), raised(FRONT)), DARK
    yield (raised(FRONT), raised(right), raised(back), raised(left)), PALE
    yield from stud(raised(at(1.5, 0.5, 0)), (PALE, MIDDLE))
    yield from stud(raised(at(0.5, 0.5, 0)), PICKED)


def stud(middle: Point, colours: tuple[Grey, Grey]) -> Iterator[tuple[Sequence[Point], Grey]]:
    """Yield the side of a stud and its top."""
    x, y = middle
    top, side = colours
    low = [oval(middle, math.pi + math.pi * i / SIDES) for i in range(SIDES + 1)]
    yield (*low, (x + STUD[0], y + STUD_HEIGHT), (x - STUD[0], y + STUD_HEIGHT)), side
    yield [oval((x, y + STUD_HEIGHT), 2 * math.pi * i / SIDES) for i in range(SIDES)], top


def oval(middle: Point, angle: float) -> Point:
    """Return a point on the rim of a stud."""
    return middle[0] + STUD[0] * math.cos(angle), middle[1] + STUD[1] * math.sin(angle)


def at(right: float, left: float, up: float) -> Point:
    """Return the place of a point of the brick in the picture."""
    parts = zip(FRONT, RIGHT, LEFT, UP, strict=True)
    x, y = (start + right * a + left * b + up * c for start, a, b, c in parts)
    return x, y


def raised(point: Point) -> Point:
    """Return the point of the brick's top over one of its bottom."""
    return point[0] + UP[0], point[1] + UP[1]


if __name__ == "__main__":
    sys.exit(main())
