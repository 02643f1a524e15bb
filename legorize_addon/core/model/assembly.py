"""A model as one object: its bricks, the parts that they are, and how they touch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Mask
from .bricks import Bricks, concatenate
from .catalogue import Catalogue

if TYPE_CHECKING:
    from .contacts import ContactGraph


@dataclass(frozen=True, eq=False)
class Assembly:
    """Bricks of a catalogue; what follows from them is computed once, at its first use.

    The word and the idea are those of rigid-block equilibrium: blocks and the
    interfaces between them.

    Attributes
    ----------
    bricks : Bricks
        One row each.
    catalogue : Catalogue
        Whose parts the bricks are.
    """

    bricks: Bricks
    catalogue: Catalogue

    def __len__(self) -> int:
        """Return the number of bricks."""
        return len(self.bricks)

    @cached_property
    def graph(self) -> ContactGraph:
        """The cells of the bricks and the graph of their contacts."""
        # loaded at the first use: the graphs of scipy
        from .contacts import contact_graph

        return contact_graph(self.bricks, self.catalogue)

    @cached_property
    def mass(self) -> Floats:
        """Mass of each brick in g, (n,) float64."""
        mass: Floats = self.catalogue.mass[self.bricks.part]
        return mass

    @cached_property
    def height(self) -> NDArray[np.int32]:
        """Height of each brick in plates, (n,) int32."""
        return self.catalogue.height[self.bricks.part].astype(np.int32)

    @cached_property
    def middles(self) -> Floats:
        """Middle of the stud squares of each brick, x and y in studs, (n, 2) float64."""
        from .contacts import middles

        return middles(self.bricks, self.catalogue)

    @cached_property
    def centre_of_mass(self) -> Floats:
        """Middle of the weight of all bricks, x and y in studs, (2,) float64."""
        middle: Floats = self.mass @ self.middles / self.mass.sum()
        return middle

    def take(self, rows: NDArray[np.integer] | Mask) -> Assembly:
        """Return the given bricks as a model of their own."""
        return Assembly(self.bricks.take(rows), self.catalogue)

    def with_more(self, tables: Sequence[Bricks]) -> Assembly:
        """Return the model with more bricks behind its own."""
        return Assembly(concatenate([self.bricks, *tables]), self.catalogue) if tables else self
