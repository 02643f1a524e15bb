"""An estimate of a build before it is made: size, number of bricks, time and memory.

All of it follows from the extent of the mesh, its area and its volume, which
take milliseconds. The coefficients were fitted to builds of eight models at 24
to 192 studs, non-negative and by least relative squares:
``python scripts/benchmark.py budget`` repeats the measurement and says how far
off the estimates are.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from types import MappingProxyType
from typing import Final, Self

import numpy as np

from .arrays import Floats
from .mesh import TriangleMesh, checked_vertices, scale_of_extent, turn_mesh
from .progress import duration
from .settings import Settings
from .slicing import ALPHA
from .units import BRICK, MM_PER_CM, PLATES_PER_BRICK, STUD

AGAIN: Final = " again"
"""End of the name of a stage that runs a second time."""

_FACE: Final = np.array([STUD * BRICK, STUD * BRICK, STUD * STUD])
"""Faces of a unit brick across x, y and z in mm^2."""

_FLAT: Final = 0.999
"""Cosine from which a triangle counts as perpendicular to an axis: large bricks cover it."""

_AT_ONCE: Final = 8192
"""Triangles that are measured at a time: a million take a third of the time that they take all at once."""

COUNTED: Final = ("parts", "budget")
"""Ways to set the size by what a model comes to."""

_USUAL_PRICE: Final = 0.1
"""Of a part in whatever currency: a brick costs some 0.1 dollars or euros. It only decides where a search begins."""

_FINE: Final = 1.01
"""Factor between scales below which they count as one."""

_ENDLESS: Final = 1e6
"""Seconds from which the expected time is not shown any more."""


def _metres(cm: float) -> str:
    """Return a length in words."""
    return f"{cm:.0f} cm" if cm < 100 else f"{_number(cm / 100)} m"


def _number(number: float) -> str:
    """Return a number that is not small rounded to three digits."""
    if number >= 1e9:
        return f"{number:.1e}"
    if number < 10:
        return f"{number:.1f}".removesuffix(".0")
    step = 10 ** max(0, math.floor(math.log10(number)) - 2)
    return f"{round(number / step) * step:,}"


@dataclass(frozen=True, slots=True)
class Estimate:
    """What a build will come to.

    Attributes
    ----------
    studs : (float, float)
        Extent along x and y.
    layers : int
        Height in bricks.
    cm : (float, float, float)
        Extent along x, y and z.
    cells : float
        Unit cells of the grid.
    bricks : int
        About how many bricks, without supports.
    megabytes : float
        Estimated peak memory of the process.
    stages : mapping of str to float
        About how many CPU seconds each stage takes, in their order.
    """

    studs: tuple[float, float]
    layers: int
    cm: tuple[float, float, float]
    cells: float
    bricks: int
    megabytes: float
    stages: Mapping[str, float]

    @property
    def seconds(self) -> float:
        """About how many CPU seconds all stages take."""
        return sum(self.stages.values())

    def sentence(self) -> str:
        """Return the estimate in a sentence for the user, without a full stop."""
        wide, deep = (max(1, round(studs)) for studs in self.studs)
        cost = f" and take about {duration(self.seconds)} and {_number(self.megabytes / 1000)} GB"
        return (
            f"The model would be {_metres(self.cm[2])} high ({_number(self.layers)} layers) on {_number(wide)} x "
            f"{_number(deep)} studs, have about {_number(self.bricks)} bricks,"
        ).removesuffix("," if self.seconds > _ENDLESS else "") + ("" if self.seconds > _ENDLESS else cost)


@dataclass(frozen=True, slots=True, eq=False)
class Measured:
    """What an estimate needs to know of a mesh: sums over its triangles, which count the same in every size.

    Attributes
    ----------
    extent : (3,) float64 array
        In world mm, upright.
    flat, curved : float
        Faces of unit bricks that flat and other surfaces come to, at scale 1.
    volume : float
        Unit bricks in it at scale 1.
    triangles, texels : int
    """

    extent: Floats
    flat: float
    curved: float
    volume: float
    triangles: int
    texels: int

    @classmethod
    def of(cls, mesh: TriangleMesh, up: str) -> Self:
        """Measure a mesh as read, in world mm, of which an axis points up.

        Raises
        ------
        MeshError
            The mesh has no faces, too few triangles, no size, or coordinates that
            are no finite numbers or too great.
        """
        mesh = turn_mesh(mesh, up)
        extent = np.ptp(checked_vertices(mesh), axis=0)
        texels = sum(image.shape[0] * image.shape[1] for image in mesh.images)
        return cls(extent, *_faces_and_volume(mesh), len(mesh.faces), texels)


def estimate(mesh: TriangleMesh, settings: Settings) -> Estimate:
    """Estimate a build without building anything.

    Parameters
    ----------
    mesh : TriangleMesh
        As read, in world mm.
    settings : Settings

    Returns
    -------
    Estimate

    Raises
    ------
    MeshError
        As for :meth:`Measured.of`.
    SettingsError
        The mesh has no extent along the side that should get the given size.
    """
    return estimate_of(Measured.of(mesh, settings.up), settings)


def estimate_of(measured: Measured, settings: Settings) -> Estimate:
    """Estimate a build of a mesh that was measured, see :func:`estimate`; its triangles take no time here."""
    if settings.size_by in COUNTED:
        settings = counted_size_of(measured, settings)
    extent = measured.extent
    scale = scale_of_extent(
        extent,
        size_by=settings.size_by,
        width=settings.width,
        height=settings.height,
        scale=settings.scale,
        cm=settings.cm,
    )
    size = extent * scale
    flat, curved, volume = measured.flat * scale**2, measured.curved * scale**2, measured.volume * scale**3
    bricks = max(1.0, _FLAT_BRICKS * flat + _CURVED_BRICKS * curved)
    if not settings.hollow:
        bricks += _INSIDE_BRICKS * max(0.0, volume - flat - curved)
    bricks_high = max(1, math.ceil(size[2] / BRICK - 1e-9))
    columns = np.prod(np.ceil(np.maximum(ALPHA * size[:2] / STUD, size[:2] / STUD + 2)))
    of_build = _Features(
        triangles=measured.triangles,
        texels=measured.texels,
        cells=float(columns) * bricks_high * PLATES_PER_BRICK,
        faces=flat + curved,
        bricks=bricks,
        crowd=bricks**1.5,
    )
    return Estimate(
        studs=(float(size[0] / STUD), float(size[1] / STUD)),
        layers=bricks_high,
        cm=(float(size[0] / MM_PER_CM), float(size[1] / MM_PER_CM), float(size[2] / MM_PER_CM)),
        cells=of_build.cells,
        bricks=round(bricks),
        megabytes=_MEGABYTES.of(of_build),
        stages=_stages(of_build, settings),
    )


def counted_size(mesh: TriangleMesh, settings: Settings) -> Settings:
    """Return settings with the scale at which a model may have the number of parts, or the price, that was asked for.

    Parameters
    ----------
    mesh : TriangleMesh
        As read, in world mm.
    settings : Settings
        Its size is set by parts or by a budget.

    Returns
    -------
    Settings
        Its size is set by the scale. Without knowing prices, a part is taken to cost a tenth.
    """
    return counted_size_of(Measured.of(mesh, settings.up), settings)


def counted_size_of(measured: Measured, settings: Settings) -> Settings:
    """Return the same settings as :func:`counted_size`, for a mesh that was measured."""
    wanted = settings.parts if settings.size_by == "parts" else max(settings.budget / _USUAL_PRICE, 1.0)
    low, high = 1e-4, 1e6
    # the estimate never falls as the scale grows
    while high / low > _FINE:
        middle = math.sqrt(low * high)
        if estimate_of(measured, replace(settings, size_by="scale", scale=middle)).bricks < wanted:
            low = middle
        else:
            high = middle
    return replace(settings, size_by="scale", scale=low)


def megabytes(cells: int, bricks: int) -> float:
    """Return about how much memory the bricks of a model take, without a mesh."""
    return _MEGABYTES.of(_Features(cells=float(cells), bricks=float(bricks)))


@dataclass(frozen=True, slots=True)
class _Features:
    """The quantities that costs depend on, or the cost of one unit of each.

    Attributes
    ----------
    constant, triangles, texels, cells : float
    faces : float
        Faces of unit bricks that the surface comes to.
    bricks : float
        About how many there will be.
    crowd : float
        Bricks to the power of 1.5, for costs that grow faster than the model.
    """

    constant: float = 1.0
    triangles: float = 0.0
    texels: float = 0.0
    cells: float = 0.0
    faces: float = 0.0
    bricks: float = 0.0
    crowd: float = 0.0

    def of(self, build: _Features) -> float:
        """Return the sum over all features of a build, each at its cost."""
        return sum(float(getattr(self, entry.name) * getattr(build, entry.name)) for entry in fields(self))


_FLAT_BRICKS: Final = 0.148
_CURVED_BRICKS: Final = 0.202
_INSIDE_BRICKS: Final = 0.065
"""Bricks to a face of a unit brick in flat and in other surfaces, and to a unit brick inside a solid model."""

_MEGABYTES: Final = _Features(constant=130.0, texels=1.3e-5, cells=3.5e-5, bricks=0.021)
"""Peak of the resident memory of a process."""

_SECONDS: Final[Mapping[str, _Features]] = MappingProxyType({
    "mesh": _Features(constant=0.007, triangles=2.1e-6),
    "colours": _Features(constant=0.066, texels=1.5e-7),
    "slicing": _Features(constant=0.006, triangles=1.4e-6, faces=7.6e-8),
    "trajectories": _Features(constant=0.006, triangles=3.4e-7, faces=7.8e-8),
    "unit bricks": _Features(constant=0.092, faces=4.2e-5, cells=1.3e-7),
    "overhangs": _Features(constant=0.002, faces=1.3e-7, cells=4.7e-8),
    "hollowing": _Features(constant=0.005, faces=2.6e-6, cells=2.7e-7),
    "surface": _Features(constant=0.05, faces=5e-5, cells=4e-7),
    "layout": _Features(constant=0.03, bricks=4.1e-4, crowd=3.4e-6),
    "ties": _Features(constant=0.0, bricks=2e-5),
    "strengthening": _Features(constant=0.032, crowd=3.8e-6),
    "stability": _Features(constant=0.017, crowd=1.4e-6),
    "bracing": _Features(constant=0.0, crowd=2.3e-6),
    "pieces": _Features(constant=0.0, bricks=1.2e-5),
    "supports": _Features(constant=0.079, bricks=2.9e-4, cells=2.6e-7),
    f"stability{AGAIN}": _Features(constant=0.0, crowd=1e-6),
})  # fmt: skip
"""CPU seconds of the stages. Those of strengthening and stability were fitted to eight models at 24 and 48 studs. With
bracing, which is a guess, they are rough: models of one size differ fiftyfold, by how weak they are."""

_TOPS: Final = _Features(bricks=4e-4, crowd=2e-6)
"""CPU seconds of tiles on top: their forces take as long as those of the layout."""

TIERS: Final = MappingProxyType({"fast": 0.3, "standard": 1.0, "exact": 6.0, "learned": 8.0})
"""Time of each tier of the layout, as a multiple of the standard one."""

PROOF: Final = 3.0
"""Time of the proof of all steps, as a multiple of everything else."""


def _faces_and_volume(mesh: TriangleMesh) -> tuple[float, float, float]:
    """Return how many faces of unit bricks lie in flat and in other surfaces, and the unit bricks of the volume."""
    place = np.ascontiguousarray((mesh.vertices - mesh.vertices[mesh.faces[0, 0]]).T)
    corners = np.ascontiguousarray(mesh.faces.T)
    flat, whole, volume = 0.0, 0.0, 0.0
    for start in range(0, corners.shape[1], _AT_ONCE):
        a, b, c = (place[:, corner] for corner in corners[:, start : start + _AT_ONCE])
        b -= a
        c -= a
        # a third of the time of numpy.cross
        normal = np.stack([b[i] * c[j] - b[j] * c[i] for i, j in ((1, 2), (2, 0), (0, 1))])
        across = np.abs(normal)
        level = across.max(axis=0) ** 2 >= _FLAT**2 * np.einsum("ij,ij->j", normal, normal)
        faces = (0.5 / _FACE) @ across
        flat, whole = flat + float(faces[level].sum()), whole + float(faces.sum())
        volume += float(np.einsum("ij,ij->", a, normal)) / 6
    return flat, max(whole - flat, 0.0), abs(volume) / (STUD * STUD * BRICK)


def _stages(build: _Features, settings: Settings) -> dict[str, float]:
    """Return the expected CPU seconds of the stages."""
    seconds = {name: cost.of(build) for name, cost in _SECONDS.items()}
    seconds["layout"] *= TIERS[settings.layout]
    if settings.surface != "slopes" and not settings.half_studs:
        del seconds["surface"]
    if settings.smooth:
        seconds["pieces"] += _TOPS.of(build)
    if settings.prove_steps:
        seconds["proof"] = PROOF * sum(seconds.values())
    return seconds
