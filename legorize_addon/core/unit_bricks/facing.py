"""The direction that a flat model faces: a picture or a relief, lying or standing.

A backed picture is only seen from the front, so its front decides the colours of its bricks, and the backing goes to
the other side.
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
"""How much more of the surface must face one way than the other; a closed surface faces both ways equally."""

_FORWARD: Final = 0.1
"""Cosine to the front from which surface counts as part of the picture."""

_EDGE: Final = 1e-6
"""Weight of surface that faces sideways, which decides only where no front is on a brick."""

_UP: Final = 2


@dataclass(frozen=True, slots=True)
class Facing:
    """The direction that a flat model faces.

    Attributes
    ----------
    axis : int
        The axis along which it is thin: 0, 1 or 2 for x, y or z.
    sign : int
        Whether it looks along the axis, 1, or against it, -1.
    """

    axis: int
    sign: int

    def weighed(self, samples: SurfaceSamples) -> SurfaceSamples:
        """Return the samples with those that face forward first, and without those that face backward.

        Samples that face sideways count only behind the foremost brick: the edges of a picture do not frame it, but a
        relief has walls.

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
    """Find out which way a flat model faces.

    A lying model faces up. A standing one faces the way of its surface if that is open, else the side that shows more
    colours; if these are equal it faces -y or +x, as in Blender's views from the front and from the right.

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
    """Return how many more brick colours the surface facing along an axis has than the surface facing against it."""
    turned = replace(mesh, vertices=np.roll(mesh.vertices, _UP - axis, axis=1))
    corner: Floats = turned.vertices[:, :2].min(axis=0)
    face, _, uvs = vertical_hits(turned, corner=corner, pitch=STUD)
    colour = surface.at(mesh.face_image[face], uvs)
    looks: Mask = turned.normals[face, _UP] > 0
    return len(np.unique(colour[looks])) - len(np.unique(colour[~looks]))
