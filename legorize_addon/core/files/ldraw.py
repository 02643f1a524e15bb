"""Bricks to LDraw text and back.

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
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats
from ..errors import BuildError
from ..model import MISSING_CELL, Assembly, Bricks, Catalogue, Part, Role
from ..safe_text import one_line, title_line
from ..units import LDU_PER_MM, PLATE_LDU, STUD_LDU

MATRICES: Final = ("1 0 0 0 1 0 0 0 1", "0 0 -1 0 1 0 1 0 0", "-1 0 0 0 1 0 0 0 -1", "0 0 1 0 1 0 -1 0 0")
"""LDraw's rotation for 0 to 3 quarter turns, counter-clockwise as seen from above."""

MAIN_COLOUR: Final = 16
"""LDraw's code for the colour that a sub-model is given by the line that uses it."""

SNAP: Final = 0.01
"""How far in LDU a coordinate that is read may lie off the grid, for numbers rounded by other programs."""

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


def read_ldr(text: str, catalogue: Catalogue) -> Bricks:
    """Read LDraw text, sub-models included, as bricks on the grid.

    Parameters
    ----------
    text : str
        An LDraw model or multi-part document; the first model is the one read.
    catalogue : Catalogue
        The parts it may use.

    Returns
    -------
    Bricks
        In the order of the file, sub-models where they are called. Steps without
        bricks do not count. Role and piece are ``SHELL`` and 0 where no
        ``0 !LEGORIZE`` line says otherwise.

    Raises
    ------
    BuildError
        A line is not understood, a part is not in the catalogue, off the grid,
        tilted or mirrored, or a model contains itself.
    """
    files = _sections(text)
    rows = []
    step = filled = 0
    for item in _flatten(files, _Item(0, next(iter(files)), MAIN_COLOUR, 0, (0, 0, 0))):
        if item is None:
            step = filled
        else:
            filled = step + 1
            rows.append((*_seat(item, catalogue), step))
    table = np.array(rows, np.int64).reshape(-1, 9)
    return Bricks(
        part=table[:, 0].astype(np.int16),
        corner=table[:, 1:4].astype(np.int32),
        turn=table[:, 4].astype(np.uint8),
        colour=table[:, 5].astype(np.int16),
        role=table[:, 6].astype(np.uint8),
        piece=table[:, 7].astype(np.int16),
        step=table[:, 8].astype(np.int32),
    )


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
        f"1 {colour} {x} {y} {z} {MATRICES[quarter]} {assembly.catalogue.parts[part].number}.dat"
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
    origin = np.array([[_origin(part, quarter) for quarter in range(4)] for part in catalogue.parts])[bricks.part, turn]
    return turn, origin + bricks.corner[:, [0, 2, 1]] * np.array((STUD_LDU, -PLATE_LDU, STUD_LDU))


def _origin(part: Part, turn: int) -> tuple[int, int, int]:
    """Return a part's origin in LDU, from the lowest corner of its bounding box."""
    sides = (part.width, part.length) if turn % 2 else (part.length, part.width)
    if part.corner:
        # the elbow lies diagonally opposite the missing cell
        sides = (3 - 2 * MISSING_CELL[turn][0], 3 - 2 * MISSING_CELL[turn][1])
    return sides[0] * STUD_LDU // 2, -part.height * PLATE_LDU, sides[1] * STUD_LDU // 2


@dataclass(frozen=True, slots=True)
class _Item:
    """A part or sub-model as a line names it: numbers of LDraw's own frame, quarter turns for the matrix."""

    line: int
    reference: str
    colour: int
    turn: int
    offset: tuple[int, int, int]
    role: int = Role.SHELL
    piece: int = 0


_Sections = dict[str, list[tuple[int, list[str]]]]


def _sections(text: str) -> _Sections:
    """Return the numbered, split lines of each model by its name in lower case."""
    sections: _Sections = {}
    name: str | None = ""
    for number, words in enumerate((line.split() for line in text.splitlines()), start=1):
        if words[:2] == ["0", "FILE"]:
            name = " ".join(words[2:]).lower()
        elif words[:2] == ["0", "NOFILE"]:
            name = None
        elif words and name is not None:
            sections.setdefault(name, []).append((number, words))
    return sections or {"": []}


def _flatten(files: _Sections, model: _Item, within: tuple[str, ...] = ()) -> Iterator[_Item | None]:
    """Yield the parts of a model where they stand in the end, and None where a step ends."""
    if model.reference in within:
        raise BuildError(f"Line {model.line} puts the model {model.reference} into itself: remove that line.")
    role, piece = int(Role.SHELL), 0
    for line, words in files[model.reference]:
        if words[:2] in (["0", "STEP"], ["0", "ROTSTEP"]):
            yield None
        elif words[:3] == ["0", "!LEGORIZE", "ROLE"]:
            role, piece = _kind(line, words)
        elif words[0] == "1":
            item = _placed(model, _item(line, words), role, piece)
            if item.reference in files:
                yield from _flatten(files, item, (*within, model.reference))
            else:
                yield item
        elif words[0] != "0":
            raise BuildError(f"Line {line} draws geometry of its own: only parts of the catalogue can be read.")


def _placed(model: _Item, item: _Item, role: int, piece: int) -> _Item:
    """Return an item of a sub-model where the sub-model stands."""
    (a, b, c), (x, y, z) = model.offset, item.offset
    for _ in range(model.turn):
        x, z = -z, x
    colour = model.colour if item.colour == MAIN_COLOUR else item.colour
    return _Item(item.line, item.reference, colour, (model.turn + item.turn) % 4, (a + x, b + y, c + z), role, piece)


def _kind(line: int, words: list[str]) -> tuple[int, int]:
    try:
        _, role, _, piece = words[2:]
        if not 0 <= int(piece) < 2**15:
            raise ValueError(piece)
        return int(Role[role]), int(piece)
    except (KeyError, ValueError) as error:
        raise BuildError(f"Line {line} names no known role and piece: remove it.") from error


def _item(line: int, words: list[str]) -> _Item:
    try:
        colour = int(words[1], 0)
        x, y, z, *entries = (_whole(word) for word in words[2:14])
        turn = MATRICES.index(" ".join(str(entry) for entry in entries))
    except ValueError as error:
        raise BuildError(f"Line {line} is not an upright part on the grid ({error}): remove it.") from error
    return _Item(line, " ".join(words[14:]).lower(), colour, turn, (x, y, z))


def _whole(word: str) -> int:
    value = float(word)
    # the negated form also refuses not-a-number
    if not abs(value) < 2**30 or abs(value - round(value)) > SNAP:
        raise ValueError(f"{word} is not a whole number")
    return round(value)


def _seat(item: _Item, catalogue: Catalogue) -> tuple[int, ...]:
    """Return part row, corner (x, y, z), turn, colour, role and piece of a part that was read."""
    row = catalogue.part_row(item.reference.removesuffix(".dat"))
    part = catalogue.parts[row]
    turn = item.turn % part.turns
    x, minus_z, y = (at - own for at, own in zip(item.offset, _origin(part, turn), strict=True))
    if x % STUD_LDU or y % STUD_LDU or minus_z % PLATE_LDU:
        raise BuildError(f"Line {item.line}: part {part.number} lies between the cells of the grid: move it.")
    if not 0 <= item.colour < 2**15 or item.colour == MAIN_COLOUR:
        raise BuildError(f"Line {item.line}: colour {item.colour} is not a brick colour: choose another one.")
    return row, x // STUD_LDU, y // STUD_LDU, -minus_z // PLATE_LDU, turn, item.colour, item.role, item.piece
