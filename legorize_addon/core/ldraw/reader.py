"""LDraw documents as bricks, and what could not be read of them, in sentences."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np

from ..arrays import Ints, Mask
from ..errors import BuildError
from ..files import MAIN_COLOUR
from ..model import Bricks, Catalogue, jumper_turn, part_images
from .colours import Replaced, brick_colours
from .flatten import EDGE_COLOUR, Parts, flatten
from .lattice import cells, quarter_turns
from .lines import DIRECT, FARTHEST, Document, brief, decoded, parse, section_has_parts

SUFFIXES: Final = (".ldr", ".mpd")
"""Names of files that are read end like this."""

SHOWN: Final = 8
"""Numbers of parts, or of lines, that a sentence names."""

MOST_FILES: Final = 200
"""Files beside a model that it may call."""


@dataclass(frozen=True, slots=True, eq=False)
class LdrawModel:
    """What was read of a document.

    Attributes
    ----------
    bricks : Bricks
        In the order of the file, sub-models where they are called, on the lattice
        of most of its parts. ``step`` counts steps that have bricks. Role and
        piece are ``SHELL`` and 0 where no comment of ours says otherwise.
    line : (n,) int64 array
        Line of each brick.
    has_steps : bool
        Whether the author divided the model into steps.
    left_out : mapping of str to int
        Numbers of parts that the catalogue does not have, and how many of each.
    remarks : tuple of str
        What was left out or changed, a sentence each.
    """

    bricks: Bricks
    line: Ints
    has_steps: bool
    left_out: dict[str, int]
    remarks: tuple[str, ...]


def read_file(path: Path, catalogue: Catalogue) -> LdrawModel:
    """Read an LDraw file; sub-models may be files beside it.

    Parameters
    ----------
    path : pathlib.Path
        A .ldr or .mpd file.
    catalogue : Catalogue
        The parts and colours that bricks may have.

    Returns
    -------
    LdrawModel

    Raises
    ------
    BuildError
        The file cannot be read, is no LDraw file, or has no brick that can be read.
    """
    found = read_ldraw(decoded(_bytes(path), path.name), catalogue, beside=lambda name: _beside(path, name))
    if not len(found.bricks):
        why = f" {found.remarks[0]}" if found.remarks else ""
        raise BuildError(f"{path.name} has no brick that can be read: open a model of bricks and plates.{why}")
    return found


def read_ldraw(text: str, catalogue: Catalogue, *, beside: Callable[[str], str | None] | None = None) -> LdrawModel:
    """Read an LDraw document.

    Parameters
    ----------
    text : str
        A model, or a multi-part document of which the first model is read.
    catalogue : Catalogue
        The parts and colours that bricks may have.
    beside : callable, optional
        Returns the text of another file by its name, or None.

    Returns
    -------
    LdrawModel
        Maybe without bricks.

    Raises
    ------
    BuildError
        A model contains itself, or there are too many parts.
    """
    rows = {f"{number}.dat": row for row, part in enumerate(catalogue.parts) for number in (part.number, *part.aliases)}
    document = parse(text)
    if beside is not None:
        _add_files(document, beside)
    parts, names = flatten(document, rows.__contains__)
    part = np.array([rows.get(name.rsplit("/", 1)[-1], -1) for name in names], np.int64)[parts.name]
    known = part >= 0
    left_out = Counter(_number(names[row]) for row in parts.name[~known].tolist())
    corner_part = np.array([each.corner for each in catalogue.parts])[part] & known
    matrix, mirrored = quarter_turns(parts.matrix, corner_part)
    shaped = np.array([each.shaped for each in catalogue.parts])[part] & known
    turn = np.where(matrix < 0, matrix, (matrix - shaped) % 4)
    part, turn, mirrored = _images(part, turn, mirrored & known, catalogue)
    # far away by calls within calls, or nowhere
    near: Mask = (np.abs(parts.place) < FARTHEST).all(axis=1)
    upright = known & near & (turn >= 0)
    corner, half, on = cells(parts.place[upright], part[upright], turn[upright], catalogue)
    seated = np.flatnonzero(upright)[on]
    colours, replaced = brick_colours(parts.colour[seated], catalogue, document.colours)
    read = parts.take(seated)
    bricks = _bricks(read, part[seated], corner[on], turn[seated], colours, catalogue)
    bricks = _with_halves(bricks, half[on], catalogue)
    remarks = (
        *_on_lines(document),
        *_on_parts(left_out),
        *_on_places(parts.line, known & ~near, known & near & ~upright, _rows(upright, ~on)),
        *_on_mirrored(parts.line, mirrored & upright),
        *_on_colours(replaced, catalogue),
    )
    return LdrawModel(bricks, read.line, bool(bricks.step.max(initial=0)), dict(left_out), remarks)


def _rows(among: Mask, wanted: Mask) -> Mask:
    """Return a mask of all rows for one of some of them."""
    found = np.zeros(len(among), dtype=bool)
    found[np.flatnonzero(among)[wanted]] = True
    return found


def _bricks(parts: Parts, part: Ints, corner: Ints, turn: Ints, colour: Ints, catalogue: Catalogue) -> Bricks:
    step = np.unique(parts.step, return_inverse=True)[1].reshape(-1)
    return Bricks(
        part=part.astype(np.int16),
        corner=corner.astype(np.int32),
        turn=(turn % np.array([each.turns for each in catalogue.parts])[part]).astype(np.uint8),
        colour=colour.astype(np.int16),
        role=parts.role.astype(np.uint8),
        piece=parts.piece.astype(np.int16),
        step=step.astype(np.int32),
    )


def _with_halves(bricks: Bricks, half: Ints, catalogue: Catalogue) -> Bricks:
    """Return bricks with the half studs that they lie beyond their corners; jumpers hold what lies otherwise."""
    jumpers = np.array([each.jumper for each in catalogue.parts])[bricks.part]
    if not half.any() and not jumpers.any():
        return bricks
    turn = bricks.turn.copy()
    for row in np.flatnonzero(jumpers).tolist():
        turn[row] = jumper_turn(catalogue.parts[bricks.part[row]], int(turn[row]), *half[row].tolist())
    return replace(bricks, turn=turn, half=half.astype(np.uint8))


def _images(part: Ints, turn: Ints, mirrored: Mask, catalogue: Catalogue) -> tuple[Ints, Ints, Mask]:
    """Return parts and their turns with mirrored wedge plates as what they look like, and which others are mirrored."""
    wedge = np.array([each.wedge for each in catalogue.parts])[part] & mirrored
    row, more = part_images(catalogue.parts, 1)[part, 0].T
    part, turn = np.where(wedge, row, part), np.where(wedge & (turn >= 0), (turn + more) % 4, turn)
    return part, turn, mirrored & ~wedge


def _number(name: str) -> str:
    return brief(name.rsplit("/", 1)[-1].removesuffix(".dat"))


def _bytes(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise BuildError(f"The file {path} cannot be read ({error.strerror}): check its name and rights.") from error


def _beside(path: Path, name: str) -> str | None:
    """Return the text of a file in the folder of another one; None if there is none."""
    if "/" in name or not name.endswith(SUFFIXES):
        return None
    try:
        found = next((each for each in path.parent.iterdir() if each.name.lower() == name and each.is_file()), None)
    except OSError:
        return None
    return None if found is None else decoded(_bytes(found), found.name)


def _add_files(document: Document, beside: Callable[[str], str | None]) -> None:
    """Take models into a document that it calls, but that are files of their own."""
    asked: set[str] = set()
    while len(asked) < MOST_FILES:
        called = {item.name for each in document.sections.values() for item in each.items if item is not None}
        new = [name for name in sorted(called) if name not in document.sections and name not in asked]
        new = [name for name in new if name.endswith(SUFFIXES)]
        if not new:
            return
        for name in new[: MOST_FILES - len(asked)]:
            asked.add(name)
            text = beside(name)
            if text is not None:
                other = parse(text)
                main = other.main
                document.sections[name] = other.sections[main]
                for inner, section in other.sections.items():
                    if inner != main:
                        document.sections.setdefault(inner, section)
                for code, value in other.colours.items():
                    document.colours.setdefault(code, value)


def _on_lines(document: Document) -> Iterator[str]:
    if document.broken:
        yield f"{_lines(document.broken)} not LDraw, left out."
    drawn = sum(len(section.drawn) for section in document.sections.values() if section_has_parts(section))
    if drawn:
        many = "1 line draws" if drawn == 1 else f"{drawn} lines draw"
        yield f"{many} geometry that is no part, left out."


def _on_parts(left_out: Counter[str]) -> Iterator[str]:
    if left_out:
        named = ", ".join(f"{count} x {number}" for number, count in left_out.most_common(SHOWN))
        others = len(left_out) - SHOWN
        more = f" and {others} more kinds" if others > 1 else f" and {others} more kind" if others == 1 else ""
        total = left_out.total()
        many = "1 part is" if total == 1 else f"{total} parts are"
        yield f"{many} not in the catalogue, left out: {named}{more}."


def _on_places(line: Ints, far: Mask, tilted: Mask, between: Mask) -> Iterator[str]:
    for rows, one, more in (
        (far, "lies more than 4 km away", "lie more than 4 km away"),
        (tilted, "does not stand upright", "do not stand upright"),
        (between, "lies between the cells of the grid", "lie between the cells of the grid"),
    ):
        if rows.any():
            yield f"{_parts(int(rows.sum()))} {one if rows.sum() == 1 else more}, left out ({_first(line[rows])})."


def _on_mirrored(line: Ints, mirrored: Mask) -> Iterator[str]:
    if mirrored.any():
        verb, where = "is" if mirrored.sum() == 1 else "are", _first(line[mirrored])
        yield f"{_parts(int(mirrored.sum()))} {verb} mirrored, read as the same part unmirrored ({where})."


def _on_colours(replaced: Sequence[Replaced], catalogue: Catalogue) -> Iterator[str]:
    names = {colour.code: colour.name for colour in catalogue.colours}
    close = [each for each in replaced if each.known]
    if close:
        named = ", ".join(f"{_colour(each.code)} as {names[each.by]} ({each.count})" for each in close[:SHOWN])
        more = f" and {len(close) - SHOWN} more" if len(close) > SHOWN else ""
        yield f"Colours that the catalogue does not have were read as the closest ones: {named}{more}."
    for each in replaced:
        if not each.known:
            what = "no colour" if each.code in (MAIN_COLOUR, EDGE_COLOUR) else f"the unknown colour {each.code}"
            verb = "has" if each.count == 1 else "have"
            yield f"{_parts(each.count)} {verb} {what}, read as {names[each.by]}."


def _colour(code: int) -> str:
    return f"#{code & 0xFFFFFF:06X}" if code >= DIRECT[0] else str(code)


def _parts(count: int) -> str:
    return "1 part" if count == 1 else f"{count} parts"


def _first(lines: Ints) -> str:
    return f"the first in line {lines.min()}" if len(lines) > 1 else f"line {lines[0]}"


def _lines(numbers: Sequence[int]) -> str:
    if len(numbers) == 1:
        return f"Line {numbers[0]} is"
    more = f" and {len(numbers) - SHOWN} more" if len(numbers) > SHOWN else ""
    return f"Lines {', '.join(map(str, numbers[:SHOWN]))}{more} are"
