"""A quick look at what settings come to: whole bricks of the quick layout, without supports, strengthening and statics.

It is made to be shown while a slider moves. So the mesh and its colours, which
take longest, are prepared once in one size for all sizes, by images of few
texels, and a model that would take too long is shown smaller.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass, replace
from typing import Any, Final

from .arrays import Floats
from .colours import SurfaceColours
from .drafting import gridded, hollowed
from .errors import LimitError
from .estimate import COUNTED, Measured, counted_size_of, estimate_of
from .layout import lay_unjoined
from .layout.learning import shipped
from .memo import Memo, Trial
from .mesh import Repairs, TriangleMesh, model_scale, scale_mesh
from .model import Bricks, Catalogue, UnitGrid, load_catalogue
from .painting import paint_cells
from .progress import Overall, silent
from .run import Run
from .settings import Settings
from .stages import find_colours, place_grid, prepare_mesh

QUICK: Final[dict[str, Any]] = {
    "layout": "fast",
    "learned_from": "",
    "surface": "studs",
    "half_studs": False,
    "fine_texture": "texels",
    "sampling": "surface",
    "grid_fit": "none",
    "feet": False,
    "plates": "none",
    "keep_specks": True,
    "owned": "",
    "prices": "",
    "goal": "fewest",
    "prove_steps": False,
}
"""Settings of every preview."""

_FIRST: Final[dict[str, Any]] = {"size_by": "cm", "cm": 25.6, "width": 32, "height": 32, "scale": 1.0}
"""The size in which mesh and colours are prepared, 32 studs along the longest side, whatever size is asked for."""

SECONDS: Final = 0.4
"""CPU seconds that a preview may be expected to take if mesh and colours are there; chosen.

On busy cores, .24 to .74 s were measured for four models at 27 to 40 studs.
"""

FEWEST: Final = 8
"""Studs of the smallest preview, chosen: with fewer nothing can be recognized."""

TEXELS: Final = 250_000
"""Texels that are looked at, chosen: of a cube of 32 studs with 5,100 faces of bricks, each has some fifty."""

_REPEATED: Final = ("slicing", "trajectories", "unit bricks", "overhangs", "hollowing", "layout")
"""Stages that another size computes again."""

_ORIGINAL: Final = 10.0
"""The scale that keeps the size of an object."""


@dataclass(frozen=True, slots=True, eq=False)
class Preview:
    """Bricks to be looked at.

    Attributes
    ----------
    bricks : Bricks
    catalogue : Catalogue
    origin : (3,) float64 array
        Corner of the grid in mm of the model.
    scale : float
        Model mm per world mm.
    studs : int
        Studs along the longer side of the model that the settings ask for.
    shown : int
        The same of the preview: fewer where that would take too long.
    """

    bricks: Bricks
    catalogue: Catalogue
    origin: Floats
    scale: float
    studs: int
    shown: int


def load_tables() -> None:
    """Load what the first preview would wait for: the catalogue, and what the quick layout has learned."""
    load_catalogue()
    shipped()


def preview(mesh: TriangleMesh, settings: Settings, memo: Memo) -> Generator[None, None, Preview]:
    """Make a preview in parts, so that whoever asks for it can do something else in between.

    Parameters
    ----------
    mesh : TriangleMesh
        As read, in world mm.
    settings : Settings
    memo : Memo
        What earlier previews have found; what this one finds is added.

    Yields
    ------
    None
        After each part.

    Returns
    -------
    Preview

    Raises
    ------
    LegorizeError
        The mesh or the settings cannot be used, or the mesh is too large to be shown at once, in one sentence.
    """
    quick, trial = replace(settings, **QUICK), memo.trial()
    thin = trial.call("thinned", (mesh,), lambda: thinned(mesh))
    ready, repairs, surface, first = _prepared(thin, quick, trial)
    # now already: a slider that moves on drops this preview, and needs them again
    memo.keep(trial)
    yield
    measured = trial.call("measured", (ready,), lambda: Measured.of(ready, "z"))
    if quick.size_by in COUNTED:
        as_read = trial.call("measured as read", (mesh, quick.up), lambda: Measured.of(mesh, quick.up))
        quick = counted_size_of(as_read, quick)
    factor, studs, shown = _factor(ready, measured, first, quick)
    run = Run.of(quick, Overall({}, silent), trial)
    sized, scale, frame, _ = run.once(place_grid, scale_mesh(ready, factor), first * factor)
    *_, grid, _ = gridded(run, sized, repairs, surface, frame)
    yield
    grid, _, shell = hollowed(run, grid)
    yield
    bricks = run.once(_lay, run.once(paint_cells, shell))
    memo.keep(trial)
    return Preview(bricks, run.catalogue, grid.origin, scale, studs, shown)


def thinned(mesh: TriangleMesh) -> TriangleMesh:
    """Return a mesh with every n-th row and column of its images, so that they have few texels together."""
    texels = sum(image.shape[0] * image.shape[1] for image in mesh.images)
    step = max(1, round((texels / TEXELS) ** 0.5))
    return replace(
        mesh,
        images=tuple(
            image[step // 2 :: step, step // 2 :: step] if min(image.shape[:2]) > step else image
            for image in mesh.images
        ),
        opacities=tuple(
            alpha[step // 2 :: step, step // 2 :: step] if alpha is not None and min(alpha.shape) > step else alpha
            for alpha in mesh.opacities
        ),
    )


def _prepared(mesh: TriangleMesh, quick: Settings, trial: Trial) -> tuple[TriangleMesh, Repairs, SurfaceColours, float]:
    """Return a mesh as it is built in the first size, its repairs, its colours, and its scale."""
    run = Run.of(replace(quick, **_FIRST), Overall({}, silent), trial)
    ready, repairs, _, scale, _ = run.once(prepare_mesh, mesh)
    return ready, repairs, run.once(find_colours, ready, mesh), scale


def _lay(run: Run, shell: UnitGrid) -> Bricks:
    """Lay the bricks; what is loose stays so."""
    return lay_unjoined(shell, run.parts.catalogue, rng=run.rng, tier="fast", filler=run.filler)


def _factor(ready: TriangleMesh, measured: Measured, first: float, quick: Settings) -> tuple[float, int, int]:
    """Return the factor from the first size to that of the preview, the studs asked for, and those of the preview."""
    if quick.size_by == "scale":
        wanted = quick.scale / _ORIGINAL / first
    else:
        wanted = model_scale(
            ready, size_by=quick.size_by, width=quick.width, height=quick.height, scale=quick.scale, cm=quick.cm
        )
    studs = _studs(measured, quick, wanted)
    low, high = 0, studs
    if _seconds(measured, quick, wanted) <= SECONDS:
        return wanted, studs, studs
    while high - low > 1:
        middle = (low + high) // 2
        if _seconds(measured, quick, wanted * middle / studs) <= SECONDS:
            low = middle
        else:
            high = middle
    if low < FEWEST:
        raise LimitError("This object is too large for a live preview: press Update to build it.")
    return wanted * low / studs, studs, low


def _studs(measured: Measured, quick: Settings, factor: float) -> int:
    found = estimate_of(measured, _scaled(quick, factor))
    return max(1, round(max(found.studs)))


def _seconds(measured: Measured, quick: Settings, factor: float) -> float:
    """Return about how many CPU seconds a preview takes if mesh and colours are there."""
    expected = estimate_of(measured, _scaled(quick, factor)).stages
    return sum(expected[name] for name in _REPEATED)


def _scaled(quick: Settings, factor: float) -> Settings:
    scale = factor * _ORIGINAL
    return replace(quick, size_by="scale", scale=scale, up="z")
