"""Bricks cut into plates, so that a plate can lie across what only touches sideways.

A brick that gives away one plate of some of its cells becomes plates: the other
two levels keep their outline, and what is left of the cut one lies between them
or beside them. So it holds everything that it held before, and the new plate as
well.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cache, lru_cache
from typing import NamedTuple

import numpy as np

from ...model import NOBODY, Bricks, Catalogue, Part, columns, footprint
from ...units import PLATES_PER_BRICK
from ..problem import Rows

Square = tuple[int, int]
"""Stud square: x and y."""


class Form(NamedTuple):
    """A part in one of its orientations, and the squares that it covers."""

    part: int
    turn: int
    height: int
    squares: tuple[Square, ...]


class Laid(NamedTuple):
    """A form in its place: corner, lowest plate, colour and role."""

    form: Form
    corner: Square
    level: int
    colour: int
    role: int

    @property
    def squares(self) -> set[Square]:
        """The stud squares that it covers."""
        x, y = self.corner
        return {(x + dx, y + dy) for dx, dy in self.form.squares}


class Seam(NamedTuple):
    """Two stud squares side by side, at a level."""

    level: int
    ends: tuple[Square, Square]


class Forms:
    """What may be laid of each height in each colour, larger ones first."""

    def __init__(self, catalogue: Catalogue) -> None:
        """List the forms of all parts."""
        self._catalogue = catalogue
        self.of = {
            (row, turn): Form(row, turn, part.height, tuple((int(x), int(y)) for x, y in footprint(part, turn)))
            for row, part in enumerate(catalogue.parts)
            for turn in range(4)
        }
        different = [
            form
            for (row, turn), form in self.of.items()
            if catalogue.parts[row].use == "model" and turn < catalogue.parts[row].turns
        ]
        self._sorted = sorted(different, key=lambda form: -len(form.squares))
        self._made: dict[tuple[int, int], list[Form]] = {}

    def made(self, height: int, colour: int) -> list[Form]:
        """Return the forms of a height that are made in a colour."""
        key = height, colour
        if key not in self._made:
            exists = self._catalogue.exists_in(np.arange(len(self._catalogue.parts)), np.int16(colour))
            self._made[key] = [form for form in self._sorted if form.height == height and exists[form.part]]
        return self._made[key]

    def within(self, squares: set[Square], through: Square, height: int, colour: int) -> Iterator[tuple[Form, Square]]:
        """Yield what covers one square and none but the given ones, larger ones first, and its corner."""
        for form in self.made(height, colour):
            if len(form.squares) <= len(squares):
                for x, y in form.squares:
                    corner = through[0] - x, through[1] - y
                    if all((corner[0] + dx, corner[1] + dy) in squares for dx, dy in form.squares):
                        yield form, corner

    def tiled(self, squares: set[Square], like: Laid, level: int, height: int) -> list[Laid] | None:
        """Cover squares in the colour and role of a brick; None if the parts for it do not exist in its colour."""
        left, tiles = set(squares), []
        while left:
            found = next(self.within(left, min(left), height, like.colour), None)
            if found is None:
                return None
            tiles.append(like._replace(form=found[0], corner=found[1], level=level))
            left -= tiles[-1].squares
        return tiles


@lru_cache(maxsize=4)
def _forms(catalogue: Catalogue) -> Forms:
    """Return the forms of a catalogue, listed once."""
    return Forms(catalogue)


class Bench:
    """A layout in which bricks are cut.

    Attributes
    ----------
    forms : Forms
    owner : (n_plates + 2, n_y, n_x) int32 array
        Number of the brick in each cell, ``NOBODY`` where there is none; one
        empty plane below and one above.
    laid : list of Laid
        Bricks by number; those that were cut stay here, but own nothing.
    fixed : set of int
        Bricks that are not cut, and that nothing is joined to: slopes, jumpers, tiles.
    """

    def __init__(self, bricks: Bricks, owner: Rows, catalogue: Catalogue) -> None:
        """Take over a layout."""
        self.forms = _forms(catalogue)
        self.owner = owner
        columns = (bricks.part, bricks.turn, bricks.corner, bricks.colour, bricks.role)
        self.laid = [
            Laid(self.forms.of[part, turn], (x, y), z, colour, role)
            for part, turn, (x, y, z), colour, role in zip(*(each.tolist() for each in columns), strict=True)
        ]
        self._cut: set[int] = set()
        surface = [part.shaped or part.jumper or part.profile == "tile" for part in catalogue.parts]
        self.fixed = {number for number, brick in enumerate(self.laid) if surface[brick.form.part]}
        self._parts = catalogue.parts

    def at(self, level: int, square: Square) -> int:
        """Return the number of the brick in a cell."""
        return int(self.owner[level + 1, square[1], square[0]])

    def holding(self, level: int, square: Square, step: int) -> int:
        """Return the number of the brick that holds what lies in a cell from below, -1, or from above, 1."""
        number = self.at(level + step, square)
        if number not in self.fixed:
            return number
        brick = self.laid[number]
        here = square[0] - brick.corner[0], square[1] - brick.corner[1]
        return number if here in _squares_held(self._parts[brick.form.part], brick.form.turn, step) else NOBODY

    def over_and_under(self, seam: Seam) -> list[int]:
        """Return the numbers of the bricks right above and right below a seam."""
        around = (self.holding(seam.level, end, step) for step in (1, -1) for end in seam.ends)
        return sorted({number for number in around if number != NOBODY})

    def open_faces(self, level: int, square: Square) -> int:
        """Count the sides of a cell that nothing touches."""
        x, y = square
        beside = self.owner[level + 1, max(y - 1, 0) : y + 2, max(x - 1, 0) : x + 2] != NOBODY
        middle = min(y, 1), min(x, 1)
        touched = int(beside[middle[0]].sum() + beside[:, middle[1]].sum()) - 2
        return 6 - touched - sum(self.at(level + step, square) != NOBODY for step in (1, -1))

    def cut(self, numbers: Sequence[int], tie: Laid) -> list[Laid] | None:
        """Return what bricks become that make room for a tie; None if they cannot."""
        pieces = []
        for number in numbers:
            brick, height = self.laid[number], tie.form.height
            if number in self.fixed or brick.form.height not in (height, height * PLATES_PER_BRICK):
                return None
            for level in range(brick.level, brick.level + brick.form.height, height):
                squares = brick.squares - tie.squares if level == tie.level else brick.squares
                tiles = self.forms.tiled(squares, brick, level, height)
                if tiles is None:
                    return None
                pieces += tiles
        return pieces

    def reaches(self, tie: Laid, seam: Seam) -> bool:
        """Return whether a tie meets something at both ends of a seam: a brick that it cuts, or one below or above."""
        top = tie.level + tie.form.height - 1
        return all(
            NOBODY != self.at(seam.level, end) not in self.fixed
            or self.holding(tie.level, end, -1) != NOBODY
            or self.holding(top, end, 1) != NOBODY
            for end in seam.ends
        )

    def holds(self, pieces: list[Laid]) -> bool:
        """Return whether the pieces that replace bricks are joined to each other and to all their neighbours."""
        place = {(piece.level, square): row for row, piece in enumerate(pieces) for square in piece.squares}
        height = pieces[0].form.height
        # bricks around come after the pieces, by number
        beside: list[set[int]] = [set() for _ in pieces]
        around: dict[int, set[int]] = {}
        for row, piece in enumerate(pieces):
            for square in piece.squares:
                for base, step in ((piece.level - height, -1), (piece.level + height, 1)):
                    if (base, square) in place:
                        beside[row].add(place[base, square])
                    elif (number := self.holding(piece.level + (height - 1) * (step > 0), square, step)) != NOBODY:
                        around.setdefault(number, set()).add(row)
        return _whole(beside + list(around.values()))

    def put(self, numbers: Iterable[int], pieces: list[Laid]) -> None:
        """Put pieces in the place of bricks."""
        self._cut.update(numbers)
        for piece in pieces:
            x, y = np.array(sorted(piece.squares)).T
            self.owner[piece.level + 1 : piece.level + 1 + piece.form.height, y, x] = len(self.laid)
            self.laid.append(piece)

    def bricks(self) -> Bricks:
        """Return the layout as it is now."""
        laid = [each for number, each in enumerate(self.laid) if number not in self._cut]
        corner = np.array([(*each.corner, each.level) for each in laid], dtype=np.int32).reshape(-1, 3)
        order = np.lexsort(tuple(corner.T))
        return Bricks(
            part=np.array([each.form.part for each in laid], dtype=np.int16),
            corner=corner,
            turn=np.array([each.form.turn for each in laid], dtype=np.uint8),
            colour=np.array([each.colour for each in laid], dtype=np.int16),
            role=np.array([each.role for each in laid], dtype=np.uint8),
            piece=np.zeros(len(laid), dtype=np.int16),
            step=corner[:, 2] // np.int32(PLATES_PER_BRICK),
        ).take(order)


@cache
def _squares_held(part: Part, turn: int, step: int) -> frozenset[Square]:
    """Return the squares, from its corner, in which a part holds what lies above it, -1, or below it, 1."""
    facts = columns(part, turn)
    there = facts.stud if step < 0 else facts.socket
    return frozenset((x, y) for x, y in facts.xy[there].tolist())


def _whole(beside: list[set[int]]) -> bool:
    """Return whether all nodes are connected, given neighbours of each; a link may be listed at one end only."""
    mutual: list[set[int]] = [set() for _ in beside]
    for node, others in enumerate(beside):
        mutual[node] |= others
        for other in others:
            mutual[other].add(node)
    seen, ahead = {0}, [0]
    while ahead:
        new = mutual[ahead.pop()] - seen
        seen |= new
        ahead += new
    return len(seen) == len(beside)
