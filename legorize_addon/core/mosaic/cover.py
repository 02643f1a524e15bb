"""What covers the base of a mosaic: the fewest parts of each colour, and parts across the seams of the base.

The covering problem is that of a sheet of a model, on the parts of the base.
Where no part joins two parts of the base by itself, two studs at their seam get
one colour and one part.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Final, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..colours import ciede2000, lab_from_srgb
from ..errors import BuildError, SettingsError
from ..layout.problem import Index, Problem, Rows, Shapes, Sheets, brick_table, placements, pose, shapes
from ..layout.solvers import exact, fewer_small, greedy, guessed_prices, linear
from ..model import (
    COLOUR_EMPTY,
    NOBODY,
    Bricks,
    Catalogue,
    Role,
    Use,
    components,
    concatenate,
    contact_graph,
    footprint,
)

Codes = NDArray[np.int16]
Surface = Literal["tiles", "plates", "bricks"]
Tier = Literal["fast", "standard", "exact"]

_HEIGHTS: Final = {"tiles": 1, "plates": 1, "bricks": 3}
_USES: Final[dict[str, tuple[Use, ...]]] = {
    "tiles": ("tiles",), "plates": ("model", "plates"), "bricks": ("model",)
}  # fmt: skip
_WAYS: Final[dict[str, Callable[[Problem, np.random.Generator], Index]]] = {
    "fast": greedy.cover, "standard": linear.cover, "exact": exact.cover
}  # fmt: skip


class Covered(NamedTuple):
    """A mosaic that is laid.

    Attributes
    ----------
    bricks : Bricks
        The base, then what covers it.
    changed : int
        Studs that got another colour, so that a part joins what is below them.
    added : int
        Bare studs that were covered for the same reason.
    """

    bricks: Bricks
    changed: int
    added: int


def surface_parts(kind: Surface, codes: Codes, filler: int, catalogue: Catalogue) -> Shapes:
    """Return the parts that cover a mosaic of a kind, in all their turns.

    Parameters
    ----------
    kind : {"tiles", "plates", "bricks"}
    codes : int16 array
        LDraw codes that occur.
    filler : int
        LDraw code for hidden parts, of which there are none.
    catalogue : Catalogue

    Returns
    -------
    Shapes
    """
    return shapes(catalogue, _HEIGHTS[kind], codes, filler, _USES[kind])


def cover_base(
    colour: Codes, base: Bricks, kind: Surface, catalogue: Catalogue, *, tier: Tier, rng: np.random.Generator
) -> Covered:
    """Cover a base.

    Parameters
    ----------
    colour : (rows, columns) int16 array
        LDraw code of each stud of the base, ``COLOUR_EMPTY`` where it stays bare.
    base : Bricks
        Of :func:`.lay_base`.
    kind : {"tiles", "plates", "bricks"}
    catalogue : Catalogue
    tier : {"fast", "standard", "exact"}
        As for the layout of models.
    rng : numpy.random.Generator

    Returns
    -------
    Covered
        One component.

    Raises
    ------
    SettingsError
        A colour has no part of one stud, or none of two that could join the base.
    """
    before, ties = colour, _none(base)
    while True:
        laid = _laid(colour, base, ties, kind, catalogue, tier=tier, rng=rng)
        pairs = contact_graph(laid, catalogue).pairs
        component = components(pairs, len(laid))[: len(base)]
        if (component == component[0]).all():
            break
        colour, ties = _tied(colour, base, ties, component, kind, catalogue)
    covered = before != COLOUR_EMPTY
    return Covered(laid, int((covered & (colour != before)).sum()), int((~covered & (colour != before)).sum()))


def _none(bricks: Bricks) -> Bricks:
    return bricks.take(np.zeros(0, dtype=np.int64))


def _laid(
    colour: Codes,
    base: Bricks,
    ties: Bricks,
    kind: Surface,
    catalogue: Catalogue,
    *,
    tier: Tier,
    rng: np.random.Generator,
) -> Bricks:
    """Lay everything but what is tied already."""
    height = _HEIGHTS[kind]
    left = np.where(_owner(ties, colour.shape, catalogue) == NOBODY, colour, np.int16(COLOUR_EMPTY))
    if (left == COLOUR_EMPTY).all():
        return concatenate([base, ties])
    among = surface_parts(kind, np.unique(left[left != COLOUR_EMPTY]), int(base.colour[0]), catalogue)
    _check_made(among, catalogue)
    sheets = Sheets(
        height=height,
        level=np.ones(1, dtype=np.int32),
        colour=left[None],
        required=(left != COLOUR_EMPTY)[None],
        role=np.full((1, *left.shape), Role.SHELL, dtype=np.uint8),
    )
    owner = np.full((height + 3, *left.shape), NOBODY, dtype=np.int32)
    owner[1] = _owner(base, left.shape, catalogue)
    required = np.zeros(owner.shape, dtype=bool)
    required[2 : 2 + height] = sheets.required
    problem = pose(sheets, among, placements(sheets, among), owner, required)
    if tier == "standard":
        problem = replace(problem, price=guessed_prices(problem))
    chosen = fewer_small(problem, _WAYS[tier](problem, rng), rng)
    if (problem.owner(chosen) == NOBODY).any():
        raise BuildError("Some studs of the mosaic could not be covered: choose another layout, or another palette.")
    return concatenate([base, ties, brick_table(problem, chosen)])


def _check_made(among: Shapes, catalogue: Catalogue) -> None:
    """Refuse colours without a part of one stud."""
    missing = ~among.made[among.size == 1, :-1].any(axis=0)
    if missing.any():
        colour = catalogue.colours[catalogue.colour_row(int(among.codes[missing][0]))]
        raise SettingsError(
            f"No part of one stud for this mosaic is made in {colour.name}: leave colour {colour.code} out."
        )


def _owner(bricks: Bricks, shape: tuple[int, ...], catalogue: Catalogue) -> Rows:
    """Return the row of the brick on each stud."""
    owner = np.full(shape, NOBODY, dtype=np.int32)
    for row, (part, turn, (x, y, _)) in enumerate(
        zip(bricks.part.tolist(), bricks.turn.tolist(), bricks.corner.tolist(), strict=True)
    ):
        squares = footprint(catalogue.parts[part], turn)
        owner[squares[:, 1] + y, squares[:, 0] + x] = row
    return owner


class _Seam(NamedTuple):
    """Pairs of neighbouring studs on different parts of the base: flat indices, and what joining them would cost."""

    first: Ints
    second: Ints
    cost: Floats
    colour: Codes


def _tied(
    colour: Codes, base: Bricks, ties: Bricks, component: Rows, kind: Surface, catalogue: Catalogue
) -> tuple[Codes, Bricks]:
    """Join the components of a base where that changes the colours least; return the colours and all ties."""
    seam = _seams(colour, base, ties, component, kind, catalogue)
    owner = _owner(base, colour.shape, catalogue).reshape(-1)
    group, found, taken = component.copy(), [], set[int]()
    # the cheapest pairs that join what is still apart (J. B. Kruskal, 1956)
    for row in np.argsort(seam.cost, kind="stable").tolist():
        studs = int(seam.first[row]), int(seam.second[row])
        one, other = group[owner[list(studs)]]
        if one != other and np.isfinite(seam.cost[row]) and taken.isdisjoint(studs):
            group[group == other] = one
            found.append(row)
            taken.update(studs)
    if not found:
        raise SettingsError(
            "No part of two studs joins the parts of the base in these colours: choose another palette or mosaic_base."
        )
    changed = colour.copy().reshape(-1)
    for end in (seam.first, seam.second):
        changed[end[found]] = seam.colour[found]
    more = _dominoes(seam, found, colour.shape[1], kind, catalogue)
    return changed.reshape(colour.shape), concatenate([ties, more])


def _seams(colour: Codes, base: Bricks, ties: Bricks, component: Rows, kind: Surface, catalogue: Catalogue) -> _Seam:
    """List where parts of the base of different components meet, and the colour that both sides could have."""
    place = np.arange(colour.size).reshape(colour.shape)
    first = np.concatenate([place[:, :-1].ravel(), place[:-1].ravel()])
    second = np.concatenate([place[:, 1:].ravel(), place[1:].ravel()])
    of = component[_owner(base, colour.shape, catalogue)].reshape(-1)
    free = (_owner(ties, colour.shape, catalogue) == NOBODY).reshape(-1)
    kept = (of[first] != of[second]) & free[first] & free[second]
    first, second, flat = first[kept], second[kept], colour.reshape(-1)
    codes = np.stack([flat[first], flat[second]])
    made = catalogue.exists_in(_domino(kind, catalogue), codes)
    # the colour of one side for both, or a part in the colour of the base on bare studs
    lab = lab_from_srgb(catalogue.rgb[np.searchsorted(catalogue.codes, np.maximum(codes, 0)) % len(catalogue.codes)])
    differs = ciede2000(lab[0], lab[1])
    bare = codes == COLOUR_EMPTY
    cost = np.where(made & ~bare, np.where(bare.any(axis=0), _BARE, differs), np.inf)
    side = cost.argmin(axis=0)
    chosen = np.take_along_axis(codes, side[None], axis=0)[0]
    least = cost.min(axis=0)
    both = bare.all(axis=0) & bool(catalogue.exists_in(_domino(kind, catalogue), int(base.colour[0])))
    return _Seam(first, second, np.where(both, 2 * _BARE, least), np.where(both, base.colour[0], chosen))


_BARE: Final = 100.0
"""Cost of a stud that gets covered though it was to stay bare: as much as the greatest differences of colours."""


def _domino(kind: Surface, catalogue: Catalogue) -> int:
    """Return the row of the part of one by two studs."""
    found: Mask = np.array(
        [
            part.use == _USES[kind][0] and (part.length, part.width, part.height) == (2, 1, _HEIGHTS[kind])
            for part in catalogue.parts
        ]
    )
    return int(found.argmax())


def _dominoes(seam: _Seam, rows: list[int], columns: int, kind: Surface, catalogue: Catalogue) -> Bricks:
    """Return parts of two studs on some pairs."""
    n, first = len(rows), seam.first[rows]
    y, x = np.divmod(first, columns)
    return Bricks(
        part=np.full(n, _domino(kind, catalogue), dtype=np.int16),
        corner=np.stack([x, y, np.ones(n, dtype=np.int64)], axis=1).astype(np.int32),
        turn=(seam.second[rows] % columns == x).astype(np.uint8),
        colour=seam.colour[rows].astype(np.int16),
        role=np.full(n, Role.SHELL, dtype=np.uint8),
        piece=np.zeros(n, dtype=np.int16),
        step=np.zeros(n, dtype=np.int32),
    )
