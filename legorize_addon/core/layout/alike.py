"""The halves of symmetric models are laid alike, where that costs hardly any more parts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Final

import numpy as np

from ..arrays import Mask
from ..model import Bricks, Catalogue, Fill, UnitGrid, contact_graph
from ..progress import Progress
from .fixed import owners_of
from .lay import Manner, cover, join_loose, sheets_and_shapes
from .problem import gather
from .symmetric import LEAST, Fold, fold_of, mirrored, some_cells

DEARER: Final = 0.01
"""Share of parts more that a symmetric layout may take, and again as many parts of supports."""


class Alike:
    """A search for a layout whose halves are alike."""

    def __init__(
        self,
        grid: UnitGrid,
        catalogue: Catalogue,
        *,
        rng: np.random.Generator,
        manner: Manner,
        filler: int,
        burden: Callable[[Bricks], float],
    ) -> None:
        """Begin with a hollowed model.

        Parameters
        ----------
        grid : UnitGrid
        catalogue : Catalogue
        rng : numpy.random.Generator
            Decides between equals.
        manner : Manner
            How much work goes into few bricks.
        filler : int
            LDraw code of hidden bricks.
        burden : function
            Estimates the parts of the supports that bricks need while they are
            built: these count like those of the model.
        """
        self.burden = burden
        self.grid, self.catalogue, self.rng = grid, catalogue, rng
        self.manner, self.filler = manner, filler

    def lay(self, free: Bricks, progress: Progress) -> tuple[Bricks, UnitGrid]:
        """Lay the halves alike, if they are and as far as that is cheap.

        Parameters
        ----------
        free : Bricks
            A layout that takes no care of symmetry.
        progress : Progress

        Returns
        -------
        bricks : Bricks
            At most :data:`DEARER` more than before, in no more components, each
            with an image in the plane in the middle of the grid where the cells
            have one. What came, if there is no such layout.
        grid : UnitGrid
            With the cells inside that had to be added for this.
        """
        return self.better(free, self.offer(progress))

    def offer(self, progress: Progress) -> tuple[Bricks, UnitGrid] | None:
        """Lay the halves alike, whatever that costs; None where they are not alike."""
        fold = fold_of(self.grid, self.catalogue)
        if fold is None:
            return None
        grid, same = mirrored(self.grid, fold)
        if np.count_nonzero(same) < LEAST * np.count_nonzero(grid.solid):
            return None
        bricks = self._laid(grid, same, fold, progress)
        work = sheets_and_shapes(grid, self.catalogue, self.filler)
        return join_loose(bricks, grid, self.catalogue, work, self.rng, progress), grid

    def better(self, free: Bricks, offer: tuple[Bricks, UnitGrid] | None) -> tuple[Bricks, UnitGrid]:
        """Return the symmetric layout if it is cheap, else the other one."""
        return (free, self.grid) if offer is None or not self._as_good(offer[0], free) else offer

    def _as_good(self, bricks: Bricks, free: Bricks) -> bool:
        """Whether a layout takes hardly more parts, and hardly more supports, in no more components."""
        now, before = (contact_graph(each, self.catalogue).n_components for each in (bricks, free))
        most = DEARER * len(free)
        return len(bricks) <= len(free) + most and now <= before and self.burden(bricks) <= self.burden(free) + most

    def _laid(self, grid: UnitGrid, same: Mask, fold: Fold, progress: Progress) -> Bricks:
        """Lay one half and the other one like it, and then the cells that have no equal image."""
        half = fold.half(grid, same)
        manner = replace(self.manner, fold=fold)
        unfolded = fold.unfold(self._cover(half, manner, progress))
        return self._around(unfolded, grid, grid.solid & ~same, progress)

    def _around(self, bricks: Bricks, grid: UnitGrid, left: Mask, progress: Progress) -> Bricks:
        """Lay the cells that are left, across the seams of the bricks that are there."""
        rest = some_cells(grid, left)
        if not (rest.cover == Fill.REQUIRED).any():
            return bricks
        there = owners_of(bricks, grid, self.catalogue)
        return gather([bricks, self._cover(rest, replace(self.manner, beside=there), progress)])

    def _cover(self, grid: UnitGrid, manner: Manner, progress: Progress) -> Bricks:
        return cover(grid, sheets_and_shapes(grid, self.catalogue, self.filler), self.rng, manner, progress)
