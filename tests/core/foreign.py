"""LDraw files as other people and programs make them, each by a rule of its own."""

from __future__ import annotations

import random

UPRIGHT = "1 0 0 0 1 0 0 0 1"
QUARTER = "0 0 1 0 1 0 -1 0 0"
BRICKS = {1: "3005", 2: "3004", 3: "3622", 4: "3010", 6: "3009", 8: "3008"}
PLATES = {1: "3024", 2: "3023", 3: "3623", 4: "3710", 6: "3666", 8: "3460"}


def along(x, y, level, length, colour=4, *, plate=False, across=False, shift=(0, 0)):
    """Return the line of a part one stud wide whose lowest stud is (x, y), its bottom `level` plates up."""
    number = (PLATES if plate else BRICKS)[length]
    middle = 10 * length
    dx, dy = (10, middle) if across else (middle, 10)
    height = 8 if plate else 24
    place = f"{20 * x + dx + shift[0]} {-8 * level - height} {20 * y + dy + shift[1]}"
    return f"1 {colour} {place} {QUARTER if across else UPRIGHT} {number}.dat"


def running_bond():
    """Return four walls of 1 x 4 bricks around 12 x 12 studs, each course moved by two studs, a step each."""
    lines = ["0 Running bond"]
    for course in range(6):
        begin = 2 * (course % 2)
        for n in range(0, 12 - begin, 4):
            length = min(4, 12 - begin - n)
            lines.append(along(n + begin, 0, 3 * course, length))
            lines.append(along(n + begin, 11, 3 * course, length))
        if begin:
            lines += [along(0, 0, 3 * course, 2), along(0, 11, 3 * course, 2)]
        for y in range(1, 11, 2):
            lines += [along(0, y, 3 * course, 2, across=True), along(11, y, 3 * course, 2, across=True)]
        lines.append("0 STEP")
    return "\n".join(lines)


def stacked_columns():
    """Return 2 x 2 bricks in twelve columns side by side that nothing joins."""
    return "\n".join(
        f"1 {1 + course % 2} {40 * x + 20} {-24 * course - 24} {40 * y + 20} {UPRIGHT} 3003.dat"
        for course in range(5)
        for x in range(4)
        for y in range(3)
    )


def random_sizes():
    """Return a wall two studs thick of bricks of random lengths."""
    dice = random.Random(7)
    lines = []
    for course in range(7):
        for y in range(2):
            x = 0
            while x < 24:
                length = min(dice.choice([1, 1, 2, 2, 3]), 24 - x)
                lines.append(along(x, y, 3 * course, length, 14))
                x += length
    return "\n".join(lines)


def all_ones():
    """Return a ball of 1 x 1 bricks."""
    inside = [
        (x, y, z)
        for z in range(7) for x in range(9) for y in range(9)
        if (x - 4) ** 2 + (y - 4) ** 2 + 1.44 * (z - 3) ** 2 < 18
    ]  # fmt: skip
    return "\n".join(along(x, y, 3 * z, 1, 15 if z > 3 else 1) for x, y, z in inside)


def plates_and_bricks():
    """Return a slab of plates, bricks on it, which begin a plate above the ground, and plates on top."""
    lines = [along(x, y, 0, 2, 2, plate=True) for y in range(8) for x in range(0, 8, 2)]
    lines += [along(x, y, 1 + 3 * z, 2, 4) for z in range(3) for y in range(8) for x in range(0, 8, 2)]
    lines += [along(x, y, 10, 1, 14, plate=True) for y in range(8) for x in range(8)]
    return "\n".join(lines)


def turned_sub_models():
    """Return a yard of four walls: the same sub-model, in the colour of each call, turned by its matrix."""
    wall = [along(x, 0, 3 * z, 1, 16) for z in range(4) for x in range(10)]
    calls = [
        f"1 1 0 0 0 {UPRIGHT} wall.ldr",
        "1 2 220 0 0 0 0 -1 0 1 0 1 0 0 wall.ldr",
        "1 4 220 0 220 -1 0 0 0 1 0 0 0 -1 wall.ldr",
        "1 14 0 0 220 0 0 1 0 1 0 -1 0 0 wall.ldr",
    ]
    return "\n".join(["0 FILE yard.ldr", *calls, "0 FILE wall.ldr", *wall])


def nested_document():
    """Return an .mpd of a tower of storeys of rows, three models deep, one row in a mirror, steps in all of them."""
    row = [along(x, 0, 0, 2, 16) for x in range(0, 8, 2)]
    storey = [f"1 16 0 0 {20 * y} {UPRIGHT} Row of bricks.ldr" for y in range(4)]
    storey[3] = "1 16 160 0 60 -1 0 0 0 1 0 0 0 1 Row of bricks.ldr"
    tower = [f"1 {colour} 0 {-24 * z} 0 {UPRIGHT} storey.ldr\n0 STEP" for z, colour in enumerate([4, 15, 4, 15])]
    return "\r\n".join([
        "0 FILE tower.ldr", "0 Tower", *tower, "0 NOFILE",
        "0 FILE storey.ldr", *storey[:2], "0 STEP", *storey[2:], "0 NOFILE",
        "0 FILE row of bricks.ldr", *row, "0 ROTSTEP 20 45 0 REL", "0 NOFILE", "",
    ])  # fmt: skip


def unknown_parts():
    """Return a house with windows, a door and tiles that the catalogue does not have."""
    lines = [
        along(x, y, 3 * z, 1, 19) for z in range(4) for x in range(8) for y in range(6) if x in (0, 7) or y in (0, 5)
    ]
    lines += [f"1 47 {40 + 80 * x} -72 10 {UPRIGHT} 60592.dat" for x in range(2)]
    lines += [f"1 4 0 -104 0 {UPRIGHT} 3069b.dat", f"1 6 80 0 10 {UPRIGHT} 60623.dat"]
    return "\n".join(lines)


def off_lattice():
    """Return a wall that begins anywhere, with bricks on jumpers half a stud beside, and one turned by 30 degrees."""
    lines = [along(x, 0, 3 * z, 1, 71, shift=(3.5, -7)) for z in range(5) for x in range(12)]
    lines += [along(2, 0, 15, 2, 4, shift=(13.5, -7)), along(6, 0, 15, 2, 4, shift=(13.5, -7))]
    lines.append("1 1 400 -24 10 0.866 0 -0.5 0 1 0 0.5 0 0.866 3001.dat")
    return "\n".join(lines)


def direct_colours():
    """Return a flag of values that no code has, one of a colour that the file itself defines."""
    stripes = ["0x2C80815", "0x2FDFDFB", "0x21A57A5", "901"]
    lines = ["0 !COLOUR Own CODE 901 VALUE #F8C60C EDGE #333333"]
    lines += [along(x, y, z, 1, stripes[y // 2], plate=True) for z in range(2) for y in range(8) for x in range(8)]
    return "\n".join(lines)


FILES = {
    "running-bond.ldr": running_bond,
    "stacked-columns.ldr": stacked_columns,
    "random-sizes.ldr": random_sizes,
    "all-ones.ldr": all_ones,
    "plates-and-bricks.ldr": plates_and_bricks,
    "turned-sub-models.ldr": turned_sub_models,
    "nested.mpd": nested_document,
    "unknown-parts.ldr": unknown_parts,
    "off-lattice.ldr": off_lattice,
    "direct-colours.ldr": direct_colours,
}
"""Ten files by their names, as functions that return the text."""
