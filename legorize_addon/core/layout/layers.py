"""From the cells of a model to its bricks, sheet after sheet.

Bricks prefer to lie across the seams of what lies below and above already; none
may hang in the air. The fast tier lays every other layer, then those between;
the others lay bricks layer by layer, upwards, and then plates, which are few
and far between, every third level at once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Final, Literal

import numpy as np

from ..catalogue import Catalogue
from ..connection import NOBODY
from ..errors import BuildError
from ..model import COLOUR_EMPTY, Bricks, Cover, Mask, UnitGrid
from ..progress import Progress, silent
from ..units import PLATES_PER_BRICK
from . import exact, greedy, linear
from .exchange import fewer_small
from .placements import Placements, placements
from .problem import BRIDGE, GROUND, Problem, pose, with_margins
from .repair import connect_loose
from .shapes import Index, Rows, Shapes, shapes
from .sheets import Sheets, split
from .svm import improved, shipped
from .table import bricks_of, gathered
from .windows import join_by_windows

FILLER: Final = 71
"""LDraw code of Light Bluish Gray, in which nearly every part is made: for bricks that nobody sees."""

_SLAB: Final = 1 << 15
"""Cells that are laid together: enough to drown the cost of a numpy call, few
enough for the memory (147 placements go through a cell in a wide area)."""

_BATCH: Final = 2000
"""Placements from which no more sheets of plates are put into one linear programme."""

_PHASES: Final = 3
"""Sheets of plates that many levels apart are laid together."""

Tier = Literal["fast", "standard", "exact"]

_BRIDGE: Final[Mapping[Tier, float]] = MappingProxyType({"fast": BRIDGE, "standard": BRIDGE, "exact": 0.05})
"""What lying across a seam saves, in bricks: for the fewest bricks it must save less than a brick in most places."""

_COVERS: Final[Mapping[Tier, Callable[[Problem, np.random.Generator], Index]]] = MappingProxyType(
    {"fast": greedy.cover, "standard": linear.cover, "exact": exact.cover}
)


def lay(
    grid: UnitGrid,
    catalogue: Catalogue,
    *,
    rng: np.random.Generator,
    tier: Tier = "standard",
    learned: bool = True,
    table: Mask | None = None,
    filler: int = FILLER,
    join: bool = True,
    progress: Progress = silent,
) -> Bricks:
    """Cover a model by bricks.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.
    catalogue : Catalogue
        Parts and colours.
    rng : numpy.random.Generator
        Decides between equals; the same state gives the same bricks.
    tier : str
        How much is done for few bricks: ``"fast"`` (see :mod:`.greedy`),
        ``"standard"`` (see :mod:`.linear`) or ``"exact"`` (see :mod:`.exact`).
    learned : bool
        Whether the fast tier makes the exchanges that :mod:`.svm` proposes.
    table : (4, 16, 16, 24) bool array, optional
        What it proposes, as :meth:`~.svm.Machine.table`; by default what was
        learned from the shipped samples.
    filler : int
        LDraw code of the bricks that nobody sees.
    join : bool
        Whether bricks that hold to nothing are joined to the others in the end.
    progress : Progress
        Told before each batch of sheets.

    Returns
    -------
    Bricks
        Every must cell lies in one brick, every may cell in one or none, each
        brick has the colour of its cells and is made in it. By ascending level,
        one step a layer.

    Raises
    ------
    BuildError
        There is nothing to build, or a must cell cannot be covered, because no
        part of one cell is made in its colour.
    """
    must = with_margins(grid.cover == Cover.MUST, False)
    if not must.any():
        raise BuildError("The model has 0 cells to build: make it larger.")
    codes = np.unique(grid.colour[grid.colour >= 0])
    work = [(each, shapes(catalogue, each.height, codes, filler)) for each in split(grid)]
    owner = np.full(must.shape, NOBODY, dtype=np.int32)
    owner[: min(int(sheets.level[0]) for sheets, _ in work) + 1] = GROUND
    slab_of_layer = np.cumsum(grid.solid.any(axis=1).sum(axis=(1, 2))) // _SLAB
    worth = (shipped() if table is None else table) if tier == "fast" and learned else None
    laid: list[Bricks] = []
    n_sheets, n_laid = sum(len(sheets) for sheets, _ in work), 0
    for sheets, among, found in _batches(work, slab_of_layer, tier):
        progress("layout", n_laid / n_sheets)
        n_laid += len(sheets)
        problem = pose(sheets, among, found, owner, must, _BRIDGE[tier])
        laid.append(_laid(problem, owner, sum(map(len, laid)), tier, worth, rng))
    if not join:
        return gathered(laid)
    bricks = connect_loose(gathered(laid), grid, work, catalogue, rng, progress)
    return join_by_windows(bricks, grid, work, catalogue, progress)


def _batches(
    work: Sequence[tuple[Sheets, Shapes]], slab_of_layer: Index, tier: Tier
) -> Iterator[tuple[Sheets, Shapes, Placements]]:
    """Yield what is laid at once, and what may lie there, one batch after the other."""
    for slab in np.unique(slab_of_layer):
        for sheets, among in work:
            inside = sheets.take(slab_of_layer[sheets.level // PLATES_PER_BRICK] == slab)
            if len(inside):
                found = placements(inside, among)
                for which in _order(inside, found, tier):
                    yield inside.take(which), among, found.on(which, inside.n_cells)


def _order(sheets: Sheets, found: Placements, tier: Tier) -> list[Index]:
    """Divide sheets into batches; no two sheets of a batch touch."""
    step = sheets.level // sheets.height
    if tier == "fast":
        halves = (np.flatnonzero(step % 2 == parity) for parity in range(2))
        return [half for half in halves if len(half)]
    if sheets.height == PLATES_PER_BRICK:
        return list(np.arange(len(sheets))[:, None])
    count = np.bincount(found.corner[:, 2], minlength=len(sheets))
    batches = []
    for phase in range(_PHASES):
        which = np.flatnonzero(step % _PHASES == phase)
        group = np.cumsum(count[which]) // _BATCH
        batches += [which[group == number] for number in np.unique(group)]
    return batches


def _laid(
    problem: Problem, owner: Rows, first: int, tier: Tier, worth: Mask | None, rng: np.random.Generator
) -> Bricks:
    """Lay sheets that do not touch; write the numbers of their bricks, from `first`, into `owner`."""
    sheets = problem.sheets
    chosen = fewer_small(problem, _COVERS[tier](problem, rng), rng)
    if worth is not None:
        chosen = improved(problem, chosen, rng, worth)
    covering = problem.owner(chosen)
    _check_covered(sheets, problem.must & (covering == NOBODY))
    here = np.full(sheets.colour.shape, NOBODY, dtype=np.int32)
    here.reshape(-1)[sheets.cells] = np.where(covering == NOBODY, NOBODY, first + covering)
    # bricks and plates of a layer share its planes
    for plate in range(1, sheets.height + 1):
        planes = owner[sheets.level + plate]
        owner[sheets.level + plate] = np.where(sheets.colour == COLOUR_EMPTY, planes, here)
    return bricks_of(problem, chosen)


def _check_covered(sheets: Sheets, missing: Mask) -> None:
    if not missing.any():
        return
    code = sheets.colour.reshape(-1)[sheets.cells[missing]][0]
    raise BuildError(
        f"{np.count_nonzero(missing)} cells cannot be covered, the first of them in colour {code}, because no part "
        "of one cell is made in it: leave it out of the palette."
    )
