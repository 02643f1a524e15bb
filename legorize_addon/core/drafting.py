"""The stages before the layout, in order: from the mesh to the cells that are to be covered."""

from __future__ import annotations

from functools import partial
from typing import Final

from .build import Cut, Draft
from .colours import SurfaceColours
from .errors import SettingsError, enough_memory
from .estimate import COUNTED, estimate
from .half_stages import Barred, find_regions
from .limits import check_limits
from .mesh import Repairs, TriangleMesh
from .model import UnitGrid
from .native import watched
from .painting import paint_draft
from .progress import Overall, Progress, silent
from .run import Run
from .settings import Settings
from .slicing import Grid, Trajectories
from .stages import (
    close_overhangs,
    cut_mesh,
    find_colours,
    find_wanted,
    hollow_out,
    link_slices,
    make_unit_grid,
    place_grid,
    prepare_mesh,
)
from .unit_bricks import Offsets, WantedColours, add_feet

STAGES: Final = ("mesh", "colours", "slicing", "trajectories", "unit bricks", "overhangs", "hollowing")
"""Their names."""


@enough_memory()
def draft_model(mesh: TriangleMesh, settings: Settings, progress: Progress = silent) -> Draft:
    """Go with a mesh as far as there is no brick yet: trajectories, unit bricks, hollowing.

    Parameters
    ----------
    mesh : TriangleMesh
        As read, in world mm.
    settings : Settings
        A size that counts bricks or costs is found by building: give the width instead.
    progress : Progress
        Called with the stage and the share that is done.

    Returns
    -------
    Draft

    Raises
    ------
    LegorizeError
        The mesh or the settings cannot be used, in one sentence.
    """
    if settings.size_by in COUNTED:
        raise SettingsError(f"size_by is {settings.size_by!r}, a size that only building finds: choose the width.")
    check_limits(expected := estimate(mesh, settings), settings)
    return watched(partial(_draft_model, mesh, settings, {name: expected.stages[name] for name in STAGES}), progress)


def _draft_model(mesh: TriangleMesh, settings: Settings, seconds: dict[str, float], progress: Progress) -> Draft:
    """Go through the stages alone."""
    run = Run.of(settings, Overall(seconds, progress))
    made, _ = drafted(run, mesh)
    run.progress.finish()
    return paint_draft(run, made)


def drafted(run: Run, given: TriangleMesh, barred: Barred = ()) -> tuple[Draft, tuple[str, ...]]:
    """Go through the stages of a run before its layout.

    Parameters
    ----------
    run : Run
    given : TriangleMesh
        As read, in world mm.
    barred : tuple of tuple, optional
        Regions that must not lie half a stud off the rest.

    Returns
    -------
    draft : Draft
        In the colours that were found, whatever replaces them.
    remarks : tuple of str
        On parts of the mesh that cannot be seen, on another size, and on feet.
    """
    with run.stage("mesh"):
        mesh, repairs, turn, scale, unseen = run.once(prepare_mesh, given)
        mesh, scale, frame, sized = run.once(place_grid, mesh, scale)
        mesh, frame, halves = run.once(find_regions, mesh, frame, barred)
    with run.stage("colours"):
        surface = run.once(find_colours, mesh, given)
    cut, trajectories, grid, feet = gridded(run, mesh, repairs, surface, frame)
    wanted = _wanted(run, mesh, surface, grid)
    grid, offsets, shell = hollowed(run, grid)
    halves = halves and halves.lying_in(grid.origin, (len(grid.colour), *grid.colour.shape[2:]))
    made = Draft(
        mesh=mesh, repairs=repairs, scale=scale, turn=turn, surface=surface, cut=cut, trajectories=trajectories,
        offsets=offsets, grid=grid, hollow=shell, wanted=wanted, halves=halves,
    )  # fmt: skip
    return made, (*unseen, *sized, *feet)


def gridded(
    run: Run, mesh: TriangleMesh, repairs: Repairs, surface: SurfaceColours, frame: Grid
) -> tuple[Cut, Trajectories, UnitGrid, tuple[str, ...]]:
    """Go from a mesh in its size and its colours to unit bricks.

    Parameters
    ----------
    run : Run
    mesh : TriangleMesh
        Repaired and scaled.
    repairs : Repairs
        What was done to it.
    surface : SurfaceColours
    frame : Grid
        The grid that lies over it.

    Returns
    -------
    tuple
        The slices, the trajectories, the unit bricks, and remarks on feet.
    """
    with run.stage("slicing"):
        cut = run.once(cut_mesh, mesh, surface, frame)
    with run.stage("trajectories"):
        trajectories = run.once(link_slices, mesh, cut, surface)
    with run.stage("unit bricks"):
        grid = run.once(make_unit_grid, mesh, repairs, trajectories, surface, frame, cut)
        grid, feet = run.once(stand_up, grid)
    return cut, trajectories, grid, feet


def _wanted(run: Run, mesh: TriangleMesh, surface: SurfaceColours, grid: UnitGrid) -> WantedColours:
    """Return the light of the surface, which no preview needs, in the time of the unit bricks."""
    with run.stage("unit bricks"):
        return find_wanted(run, mesh, surface, grid)


def hollowed(run: Run, grid: UnitGrid) -> tuple[UnitGrid, Offsets, UnitGrid]:
    """Go from unit bricks to the cells that are to be covered.

    Parameters
    ----------
    run : Run
    grid : UnitGrid

    Returns
    -------
    tuple
        The unit bricks with the colours of offset bricks, those bricks, and the shell.
    """
    with run.stage("overhangs"):
        grid, offsets = run.once(close_overhangs, grid)
    with run.stage("hollowing"):
        shell = run.once(hollow_out, grid)
    return grid, offsets, shell


def stand_up(run: Run, grid: UnitGrid) -> tuple[UnitGrid, tuple[str, ...]]:
    """Put feet on what falls over at a touch, if that is wanted; return a sentence about them as well."""
    if not run.settings.feet:
        return grid, ()
    grid, feet = add_feet(grid)
    return grid, tuple(each.sentence() for each in feet)
