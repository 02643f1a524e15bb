"""How much more surface counts than elsewhere, on a lattice in space: finer than the faces of a coarse mesh."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..arrays import Floats


@dataclass(frozen=True, slots=True, eq=False)
class WeightField:
    """Weights of the surface near the points of a lattice.

    Attributes
    ----------
    origin : (3,) float64 array
        The first point, x, y and z in mm.
    pitch : float
        Distance of the points in mm.
    values : (n_z, n_y, n_x) float32 array
        How many times more than usual the surface counts there.
    """

    origin: Floats
    pitch: float
    values: NDArray[np.float32]

    @property
    def points(self) -> Floats:
        """The points of the lattice in mm, (n, 3), as their values lie in memory."""
        place = np.indices(self.values.shape).reshape(3, -1).T[:, ::-1]
        return self.origin + self.pitch * place

    def at(self, points: Floats) -> Floats:
        """Return the weights at points in mm, (n, 3): between those of the lattice, 0 outside of it, (n,)."""
        place = ((points - self.origin) / self.pitch).T[::-1]
        found: Floats = ndimage.map_coordinates(self.values, place, np.float64, order=1, mode="constant")
        return found

    def scaled(self, factor: float) -> WeightField:
        """Return the field of a mesh that was scaled about the origin."""
        return replace(self, origin=self.origin * factor, pitch=self.pitch * factor)
