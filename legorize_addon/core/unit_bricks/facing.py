"""Which way a flat model looks: a picture or a relief, lying or standing.

A picture that is backed is seen from its front alone, so its front decides how
its bricks are coloured, and the backing goes to the other side.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ..arrays import Floats, Mask
from ..colours import SurfaceColours
from ..errors import SettingsError
from ..mesh import TriangleMesh, vertical_hits
from ..units import BRICK, STUD
from .surface_samples import SurfaceSamples

_FLAT: Final = 0.25
"""Greatest thickness of a flat model, as a share of its next larger side."""

_OPEN: Final = 0.5
"""How much more of the surface has to look one way than the other; of a closed one as much looks either way."""

_FORWARD: Final = 0.1
"""Cosine to the front from which on surface counts as part of the picture."""

_EDGE: Final = 1e-6
"""Weight of what looks aside, which decides only where nothing of the front is on a brick."""

_UP: Final = 2


@dataclass(frozen=True, slots=True)
class Facing:
    """The way that a flat model looks.

    Attributes
    ----------
    axis : int
        Along which it is thin: 0, 1 or 2 for x, y or z.
    sign : int
        Whether it looks along the axis, 1, or against it, -1.
    """

    axis: int
    sign: int

    def weighed(self, samples: SurfaceSamples) -> SurfaceSamples:
        """Return the samples with what looks forward before all else, and without what looks backward.

        What looks aside counts only behind the foremost brick: the edges of a
        picture do not frame it, but a relief has walls.

        Parameters
        ----------
        samples : SurfaceSamples

        Returns
        -------
        SurfaceSamples
        """
        along = _UP - self.axis
        normal, height = samples.normal * samples.sides, self.sign * samples.place[:, along] * samples.sides[along]
        length = np.maximum(np.linalg.norm(normal, axis=1), np.finfo(float).tiny)
        forward = self.sign * normal[:, along] / length
        behind = height < height.max(initial=-np.inf) - BRICK / STUD
        kept = (forward > _FORWARD) | (behind & (forward > -_FORWARD))
        area = np.where(forward > _FORWARD, 1.0, _EDGE) * samples.area
        return replace(samples, area=area).at(kept)


def is_flat(mesh: TriangleMesh) -> bool:
    """Return whether a mesh is a picture or a relief: at most a quarter as thick as it is broad."""
    thickness, breadth, _ = np.sort(np.ptp(mesh.vertices, axis=0))
    return bool(thickness <= _FLAT * breadth)


def facing_of(mesh: TriangleMesh, surface: SurfaceColours) -> Facing:
    """Find out which way a flat model looks.

    A lying one looks up. A standing one looks where its surface does if that is
    open, else to the side that shows more colours; where these are equal, as in
    Blender's views from the front and from the right, against y or along x.

    Parameters
    ----------
    mesh : TriangleMesh
        In mm.
    surface : SurfaceColours
        The brick colours of its texels.

    Returns
    -------
    Facing

    Raises
    ------
    SettingsError
        The model is not flat.
    """
    size = np.ptp(mesh.vertices, axis=0)
    if not is_flat(mesh):
        thickness, breadth, _ = np.sort(size)
        raise SettingsError(
            f"The model is {thickness:.0f} mm thick and {breadth:.0f} mm broad, but backing needs a picture or "
            "relief that is at most a quarter as thick as broad: set backing to 0 or make the model flatter."
        )
    axis = int(size.argmin())
    if axis == _UP:
        return Facing(axis, 1)
    along = mesh.normals[:, axis]
    balance = along.sum() / np.maximum(np.abs(along).sum(), np.finfo(float).tiny)
    if abs(balance) < _OPEN:
        balance = _more_colours(mesh, surface, axis)
    if balance == 0:
        return Facing(axis, 1 if axis == 0 else -1)
    return Facing(axis, 1 if balance > 0 else -1)


def _more_colours(mesh: TriangleMesh, surface: SurfaceColours, axis: int) -> int:
    """Return by how many brick colours what looks along an axis has more than what looks against it."""
    turned = replace(mesh, vertices=np.roll(mesh.vertices, _UP - axis, axis=1))
    corner: Floats = turned.vertices[:, :2].min(axis=0)
    face, _, uvs = vertical_hits(turned, corner=corner, pitch=STUD)
    colour = surface.at(mesh.face_image[face], uvs)
    looks: Mask = turned.normals[face, _UP] > 0
    return len(np.unique(colour[looks])) - len(np.unique(colour[~looks]))
