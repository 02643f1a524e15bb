"""Bricks to LDraw text; :mod:`legorize_addon.core.ldraw` reads it back.

LDraw's axes are right-handed with -y up, so the model's (x, y, z) becomes
(x, -z, y); lengths are LDraw units (LDU) of 0.4 mm. A part's origin is the
centre of the top face of its body, where the studs begin; a corner part has it
on the elbow stud. All numbers are whole: the same bricks give the same bytes.

References
----------
LDraw.org, "LDraw File Format Specification" and "MPD Extension".
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats
from ..model import MISSING_CELL, Assembly, Bricks, Catalogue, Part, Role, turned
from ..safe_text import one_line, title_line
from ..units import LDU_PER_MM, PLATE_LDU, STUD_LDU

MATRICES: Final = ("1 0 0 0 1 0 0 0 1", "0 0 -1 0 1 0 1 0 0", "-1 0 0 0 1 0 0 0 -1", "0 0 1 0 1 0 -1 0 0")
"""LDraw's rotation for 0 to 3 quarter turns, counter-clockwise as seen from above."""

MAIN_COLOUR: Final = 16
"""LDraw's code for the colour that a sub-model is given by the line that uses it."""

_ORIGIN_BELOW: Final = ("cheese", "curved")
"""Profiles of parts whose origin LDraw's library has at their lower face."""

LINE_END: Final = "\r\n"


def write_ldr(assembly: Assembly, *, name: str, title: str, follow: str = "") -> str:
    """Write bricks as one LDraw model.

    Parameters
    ----------
    assembly : Assembly
        The bricks, in any order.
    name : str
        File name, "model.ldr".
    title : str
        What the model shows, for the first line.
    follow : str, optional
        File that says how the model is built, which then is named, as well as the
        number of each step there.

    Returns
    -------
    str
        The text with CRLF line ends, to be written without translating them.
        One ``0 STEP`` after each building step that has bricks; turns are
        reduced by the part's own symmetry; ``0 !LEGORIZE`` lines keep role and
        piece.
    """
    remark = (
        [f"0 // The finished model. To build it, follow {one_line(follow)}: it has the supports."] if follow else []
    )
    return LINE_END.join([*header(name, title), *remark, *body(assembly, numbered=bool(follow)), ""])


def ldraw_matrix(origin: Floats, scale: float, mm_per_unit: float) -> Floats:
    """Return the transform from the scene's coordinates to those of the LDraw file.

    Parameters
    ----------
    origin : (3,) float64 array
        Lowest corner of the grid in mm of the scaled mesh.
    scale : float
        Model mm per world mm.
    mm_per_unit : float
        World mm per unit of length in the scene.

    Returns
    -------
    (4, 4) float64 array
        Row-major, for column vectors (x, y, z, 1) in scene units; gives LDU.
    """
    axes = LDU_PER_MM * np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    shift = -(axes @ origin)[:, None]
    return np.block([[axes * scale * mm_per_unit, shift], [np.eye(4)[3:]]])


def header(name: str, title: str) -> list[str]:
    """Return the first lines of a model."""
    return [f"0 {title_line(title)}", f"0 Name: {one_line(name)}", "0 Author: Legorize"]


def brick_lines(assembly: Assembly) -> list[str]:
    """Return the line of each brick, row by row: colour, place, rotation, part.

    Parameters
    ----------
    assembly : Assembly
        The bricks.

    Returns
    -------
    list of str
        Lines of type 1, without line ends; turns are reduced by the part's own
        symmetry.
    """
    turn, origin = _places(assembly.bricks, assembly.catalogue)
    table = np.column_stack([assembly.bricks.part, assembly.bricks.colour, turn, origin]).tolist()
    return [
        f"1 {colour} {x} {y} {z} {MATRICES[matrix_of(assembly.catalogue.parts[part], quarter)]} "
        f"{assembly.catalogue.parts[part].number}.dat"
        for part, colour, quarter, x, y, z in table
    ]


def body(assembly: Assembly, *, numbered: bool = False) -> Iterator[str]:
    """Yield the lines of bricks step by step, with roles, pieces, ends of steps and, if asked for, numbers between."""
    turn, _ = _places(assembly.bricks, assembly.catalogue)
    lines = brick_lines(assembly)
    order = np.lexsort(
        (
            assembly.bricks.colour,
            turn,
            assembly.bricks.part,
            *assembly.bricks.corner.T,
            assembly.bricks.role,
            assembly.bricks.piece,
            assembly.bricks.step,
        )
    )
    table = np.column_stack([order, assembly.bricks.role[order], assembly.bricks.piece[order]])
    step_ends = np.diff(assembly.bricks.step[order], append=-1) != 0
    kind, begins = None, True
    for (row, role, piece), ends in zip(table.tolist(), step_ends.tolist(), strict=True):
        if numbered and begins:
            yield f"0 // Step {assembly.bricks.step[row] + 1}"
        begins = ends
        if kind != (role, piece):
            kind = role, piece
            yield f"0 !LEGORIZE ROLE {Role(role).name} PIECE {piece}"
        yield lines[row]
        if ends:
            yield "0 STEP"


def _places(bricks: Bricks, catalogue: Catalogue) -> tuple[NDArray[np.uint8], NDArray[np.int64]]:
    """Return the quarter turns of each brick, fewest that look the same, and its place in LDU, (n, 3)."""
    turn = bricks.turn % np.array([part.turns for part in catalogue.parts], dtype=np.uint8)[bricks.part]
    origin = np.array([[part_origin(part, quarter) for quarter in range(4)] for part in catalogue.parts])[
        bricks.part, turn
    ]
    # half a stud is a whole number of LDU
    moved = (bricks.shift[:, [0, 2, 1]] * STUD_LDU).astype(np.int64)
    return turn, origin + moved + bricks.corner[:, [0, 2, 1]] * np.array((STUD_LDU, -PLATE_LDU, STUD_LDU))


def matrix_of(part: Part, turn: int) -> int:
    """Return the number of the matrix of a turned part: LDraw's slopes and wedges fall along -z, ours along x."""
    return (turn + part.shaped) % len(MATRICES)


def part_origin(part: Part, turn: int) -> tuple[int, int, int]:
    """Return a part's origin in LDU, from the lowest corner of its bounding box."""
    high = 0 if part.profile in _ORIGIN_BELOW else -part.height * PLATE_LDU
    if part.sloped:
        # under the middle of the high row, that of curves in the middle of the part
        along = part.length / 2 if part.profile in ("curved", "bow") else 0.5
        x, y = np.rint(turned(part, turn, np.array([along, part.width / 2])) * STUD_LDU).astype(int).tolist()
        return x, high, y
    sides = (part.width, part.length) if turn % 2 else (part.length, part.width)
    if part.corner:
        # the elbow lies diagonally opposite the missing cell
        sides = (3 - 2 * MISSING_CELL[turn][0], 3 - 2 * MISSING_CELL[turn][1])
    return sides[0] * STUD_LDU // 2, high, sides[1] * STUD_LDU // 2
