"""The stages in order: the one place that knows it."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np
from numpy.typing import NDArray

from .catalogue import Catalogue, load_catalogue
from .colours import SurfaceColours, chosen_palette, surface_colours
from .connection import Connection, connect
from .errors import SettingsError
from .grid import Grid, fit_grid
from .hollowing import hollow
from .layout import lay
from .mesh import Repairs, TriangleMesh, repair, scaled
from .model import Bricks, UnitGrid
from .progress import Progress, silent
from .settings import Settings
from .slicing import Slices, adaptive_heights, slice_mesh
from .trajectories import Trajectories, link_loops
from .unit_bricks import unit_bricks
from .units import BRICK, STUD

MOST_CELLS: Final = 60_000_000
"""Unit cells that a grid may have: beyond, the arrays of a run outgrow 16 GB."""

_ORIGINAL_SCALE: Final = 10.0
"""Scale factor k at which an object keeps its size (paper, section 3)."""


@dataclass(frozen=True, slots=True, eq=False)
class Build:
    """The result of every stage.

    Attributes
    ----------
    settings : Settings
        What was asked for.
    mesh : TriangleMesh
        The repaired mesh in the size of the model, in mm.
    repairs : Repairs
        What was mended.
    scale : float
        Model mm per world mm.
    surface : SurfaceColours
        The brick colour of every texel.
    slices : Slices
        The cut of the mesh.
    trajectories : Trajectories
        The coloured loops.
    layer : (n_slices,) int32 array
        Brick layer of every slice.
    grid : UnitGrid
        All unit bricks, before hollowing.
    hollow : UnitGrid
        What must and what may be built.
    bricks : Bricks
        The layout.
    connection : Connection
        How the bricks hold together.
    notes : tuple of str
        Sentences for the user.
    timings : mapping of str to float
        CPU seconds by stage.
    """

    settings: Settings
    mesh: TriangleMesh
    repairs: Repairs
    scale: float
    surface: SurfaceColours
    slices: Slices
    trajectories: Trajectories
    layer: NDArray[np.int32]
    grid: UnitGrid
    hollow: UnitGrid
    bricks: Bricks
    connection: Connection
    notes: tuple[str, ...]
    timings: Mapping[str, float]


def legorize(mesh: TriangleMesh, settings: Settings, progress: Progress = silent) -> Build:
    """Turn a textured mesh into a brick model.

    Parameters
    ----------
    mesh : TriangleMesh
        As read, in world mm.
    settings : Settings
    progress : Progress
        Told when a stage begins, and by some stages how far they are.

    Returns
    -------
    Build

    Raises
    ------
    LegorizeError
        The mesh or the settings cannot be used, in one sentence.
    """
    catalogue = load_catalogue()
    palette = chosen_palette(settings.palette, catalogue)
    rng = np.random.default_rng(settings.seed)
    timings: dict[str, float] = {}
    stage = partial(_stage, progress=progress, timings=timings)

    with stage("mesh"):
        mesh, repairs = repair(mesh)
        scale = model_scale(mesh, settings)
        mesh = scaled(mesh, scale)
        check_size(mesh)
    with stage("colours"):
        surface = _surface(mesh, settings, palette, catalogue, rng)
    with stage("slicing"):
        frame = fit_grid(mesh, symmetric=settings.symmetric)
        slices, layer = _slices(mesh, surface, frame, settings)
    with stage("trajectories"):
        trajectories = link_loops(mesh, slices, surface, chord_deviation=settings.chord_deviation)
    with stage("unit bricks"):
        grid = _unit_grid(mesh, repairs, trajectories, surface, frame, slices, layer, settings, catalogue, progress)
    with stage("hollowing"):
        shell = hollow(grid, shell=settings.shell if settings.hollow else None)
    with stage("layout"):
        bricks = lay(shell, catalogue, rng=rng, progress=progress)
        connection = connect(bricks, catalogue)
    notes = (*repairs.sentences(), *_remarks(connection))
    return Build(
        settings,
        mesh,
        repairs,
        scale,
        surface,
        slices,
        trajectories,
        layer,
        grid,
        shell,
        bricks,
        connection,
        notes,
        timings,
    )


def _surface(
    mesh: TriangleMesh,
    settings: Settings,
    palette: NDArray[np.int16],
    catalogue: Catalogue,
    rng: np.random.Generator,
) -> SurfaceColours:
    """Return the brick colours of all texels; one to one, no more of them than the palette has."""
    return surface_colours(
        mesh,
        catalogue,
        n_colours=min(settings.colours, len(palette)) if settings.one_to_one else settings.colours,
        sampling=settings.sampling,
        palette=palette,
        one_to_one=settings.one_to_one,
        rng=rng,
    )


def _slices(
    mesh: TriangleMesh, surface: SurfaceColours, frame: Grid, settings: Settings
) -> tuple[Slices, NDArray[np.int32]]:
    """Return the cut of the mesh at adaptive heights, and the layer of every slice."""
    heights, layer, _ = adaptive_heights(
        mesh,
        ground=float(frame.origin[2]),
        n_layers=frame.n_layers,
        cusp=settings.cusp,
        colour=surface.of_faces(mesh),
    )
    return slice_mesh(mesh, heights), layer


def _unit_grid(
    mesh: TriangleMesh,
    repairs: Repairs,
    trajectories: Trajectories,
    surface: SurfaceColours,
    frame: Grid,
    slices: Slices,
    layer: NDArray[np.int32],
    settings: Settings,
    catalogue: Catalogue,
    progress: Progress,
) -> UnitGrid:
    """Return the unit bricks, of which there must be one at least."""
    grid = unit_bricks(
        mesh,
        trajectories,
        surface,
        frame,
        layer=layer,
        heights=slices.heights,
        keep_thin=settings.keep_thin,
        longest=settings.cell_colour == "longest",
        catalogue=catalogue,
        closed=repairs.watertight,
        progress=progress,
    )
    _check_any(grid, mesh)
    return grid


def model_scale(mesh: TriangleMesh, settings: Settings) -> float:
    """Return the factor from the size of the mesh to that of the model.

    Parameters
    ----------
    mesh : TriangleMesh
        In world mm.
    settings : Settings

    Returns
    -------
    float
        Model mm per world mm.

    Raises
    ------
    SettingsError
        The mesh has no extent along what shall have the asked size.

    References
    ----------
    Paper, section 3: a factor k of 10 keeps the size.
    """
    size = np.ptp(mesh.vertices, axis=0)
    if settings.size_by == "scale":
        return settings.scale / _ORIGINAL_SCALE
    if settings.size_by == "width":
        wanted, extent, word = settings.width * STUD, size[:2].max(), "width"
    else:
        wanted, extent, word = settings.height * BRICK, size[2], "height"
    if extent <= 1e-9 * size.max():
        raise SettingsError(f"The mesh has a {word} of {extent:g} mm: set the size by another measure than {word}.")
    return float(wanted / extent)


def check_size(mesh: TriangleMesh) -> None:
    """Refuse a model that would not fit in memory.

    Raises
    ------
    SettingsError
        The grid would have more than ``MOST_CELLS`` cells.
    """
    studs, layers = np.ptp(mesh.vertices, axis=0)[:2] / STUD, np.ptp(mesh.vertices[:, 2]) / BRICK
    cells = float(np.prod(np.ceil(1.1 * studs) + 2) * (np.ceil(layers) + 1))
    if cells > MOST_CELLS:
        raise SettingsError(
            f"The model would be {studs[0]:.0f} x {studs[1]:.0f} studs and {layers:.0f} bricks high, {cells:.2g} cells "
            f"of at most {MOST_CELLS:.2g}: choose a smaller size."
        )


def _check_any(grid: UnitGrid, mesh: TriangleMesh) -> None:
    if not grid.solid.any():
        size = np.ptp(mesh.vertices, axis=0)
        raise SettingsError(
            f"The model would be {size[0]:.2g} x {size[1]:.2g} x {size[2]:.2g} mm, too small for one brick of "
            f"{STUD:g} x {STUD:g} x {BRICK:g} mm: choose a larger size."
        )


@contextmanager
def _stage(name: str, progress: Progress, timings: dict[str, float]) -> Iterator[None]:
    """Announce a stage and note its CPU seconds."""
    progress(name, 0.0)
    start = time.process_time()
    yield
    timings[name] = time.process_time() - start
    progress(name, 1.0)


def _remarks(connection: Connection) -> tuple[str, ...]:
    if connection.n_floating == 0:
        return ()
    return (f"{connection.n_floating} bricks hang in the air: they touch no brick that stands on the ground.",)
