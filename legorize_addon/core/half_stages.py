"""What the settings mean for half studs: where they are, which jumpers lie there, and whether all holds in the end."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from .build import Build, Draft
from .building import still_alike
from .errors import SettingsError
from .half_studs import NEEDED, HalfStudsError, Plane, choose_planes, draw_together, lay_jumpers, set_apart
from .layout import with_fixed
from .mesh import TriangleMesh
from .model import Bricks, Catalogue, UnitGrid, concatenate
from .progress import Progress, part
from .run import Run
from .settings import Settings
from .slicing import Grid
from .slope_stages import find_slopes
from .slopes import Slopes
from .statics import Stability
from .strength import check_final
from .supports import AssemblyPlan, walk_apart
from .units import PLATES_PER_BRICK, STUD

Levels = tuple[int, ...]
"""Plates below planes."""


def find_planes(
    run: Run, mesh: TriangleMesh, frame: Grid, barred: Levels
) -> tuple[TriangleMesh, Grid, tuple[Plane, ...]]:
    """Find the planes above which half studs pay; return the mesh drawn together there, and its grid."""
    settings = run.settings
    if not settings.half_studs:
        return mesh, frame, ()
    parts = run.parts.joining
    if not all(parts.exists[parts.part_row(number)].any() for number in NEEDED):
        raise SettingsError(
            f"half_studs is on, but the parts that may be laid do not have all of {', '.join(NEEDED)}: turn half_studs "
            "off, or allow other parts."
        )
    planes = choose_planes(mesh, frame, price=settings.slope_price, barred=barred)
    if not planes:
        return mesh, frame, ()
    mesh = draw_together(mesh, float(frame.origin[2]), planes)
    # what was moved back keeps a free row of cells beside it
    more = np.array([plane.half for plane in planes]).max(axis=0)
    frame = replace(
        frame,
        origin=frame.origin - STUD * np.array([*more, 0]),
        n_x=frame.n_x + int(more[0]),
        n_y=frame.n_y + int(more[1]),
        drawn_together=True,
    )
    return mesh, frame, planes


def given_bricks(run: Run, made: Draft) -> tuple[Draft, Slopes | None]:
    """Return what lies in the cells before the other bricks are laid, jumpers and slopes, and the cells for it."""
    given = None
    if made.planes:
        with run.stage("surface"):
            jumpers, cells = run.once(_find_jumpers, made)
            # a jumper has to stay
            rows = np.arange(len(jumpers))
            given = Slopes(jumpers, np.full(len(jumpers), np.inf), -1 - rows, made.grid.solid)
            made = replace(made, hollow=cells)
    if run.settings.surface == "slopes":
        with run.stage("surface"):
            given = run.once(_join_slopes, given, run.once(find_slopes, made), made.planes)
    return made, given


def _find_jumpers(run: Run, made: Draft) -> tuple[Bricks, UnitGrid]:
    """Lay the jumpers of a model; return its cells as well."""
    parts = run.parts.joining
    # in colours that the model has, where there are such
    known = parts.exists & np.isin(parts.codes, [*run.palette.tolist(), *np.unique(made.hollow.colour).tolist()])
    parts = replace(parts, exists=np.where(known.any(axis=1)[:, None], known, parts.exists))
    jumpers, cells = lay_jumpers(made.hollow, made.planes, parts, filler=run.filler)
    return jumpers, with_fixed(cells, jumpers, run.catalogue)


def _join_slopes(run: Run, jumpers: Slopes | None, slopes: Slopes, planes: tuple[Plane, ...]) -> Slopes:
    """Return jumpers, if there are any, and the slopes that do not reach through their planes."""
    if jumpers is None:
        return slopes
    low = slopes.bricks.corner[:, 2]
    high = low + run.catalogue.height[slopes.bricks.part]
    through = np.any([(low < plane.level) & (high > plane.level) for plane in planes], axis=0)
    return Slopes(
        concatenate([jumpers.bricks, slopes.bricks.take(~through)]),
        np.concatenate([jumpers.worth, slopes.worth[~through]]),
        np.concatenate([jumpers.pair, slopes.pair[~through]]),
        slopes.solid,
    )


def lie_apart(
    run: Run, plan: AssemblyPlan, planes: tuple[Plane, ...], found: Stability
) -> tuple[AssemblyPlan, Stability]:
    """Set all bricks of a plan apart; test the order of building and the forces anew.

    Raises
    ------
    HalfStudsError
        Something holds no longer that held while the model was drawn together, or equal submodels differ.
    """
    apart = walk_apart(plan, set_apart(plan.assembly, planes))
    levels = tuple(plane.level for plane in planes)
    # submodels that are equal on one grid are written once
    if (plan.walk.buildable and not apart.walk.buildable) or not still_alike(apart.steps, apart.assembly.bricks):
        raise HalfStudsError(levels)
    tested = check_final(run, apart.final)
    if (found.stable and not tested.stable) or (found.stands and not tested.stands):
        raise HalfStudsError(levels)
    return apart, tested


def with_half_studs(
    make: Callable[[Levels, TriangleMesh, Settings, Progress], Build],
    mesh: TriangleMesh,
    settings: Settings,
    progress: Progress,
) -> Build:
    """Build a model, without the half studs with which it does not hold.

    Parameters
    ----------
    make : callable
        Builds a model in which some levels must have no half studs.
    mesh : TriangleMesh
    settings : Settings
    progress : Progress

    Returns
    -------
    Build
        With a remark on planes that were given up.
    """
    barred: Levels = ()
    if not settings.half_studs:
        return make(barred, mesh, settings, progress)
    told = [0.0]

    def telling(stage: str, share: float) -> None:
        """Keep the share that was told, which never decreases."""
        told[0] = share
        progress(stage, share)

    while True:
        try:
            build = make(barred, mesh, settings, part(telling, told[0], 1.0) if barred else telling)
        except HalfStudsError as error:
            barred = tuple(sorted({*barred, *error.levels}))
            continue
        return replace(build, notes=(*build.notes, *_given_up(barred)))


def _given_up(barred: Levels) -> tuple[str, ...]:
    """Say at which layers there are no half studs although they would pay."""
    if not barred:
        return ()
    layers = ", ".join(str(level // PLATES_PER_BRICK) for level in barred)
    return (
        f"Half studs were given up above layer {layers}: with them something would rest on supports across the "
        "jumpers, collide, or not hold.",
    )


def remarks_on_half_studs(planes: tuple[Plane, ...], bricks: Bricks, catalogue: Catalogue) -> tuple[str, ...]:
    """Say what lies half a stud further on than what is below it."""
    jumpers = np.array([each.jumper for each in catalogue.parts])[bricks.part]
    told = []
    for plane, before in zip(planes, ((0, 0), *(each.half for each in planes)), strict=False):
        ways = [axis for axis, one, other in zip("xy", before, plane.half, strict=True) if one != other]
        count = int(np.count_nonzero(jumpers & (bricks.corner[:, 2] == plane.level - 1)))
        told.append(
            f"All above layer {plane.level // PLATES_PER_BRICK} lies half a stud aside along {' and '.join(ways)}, on "
            f"{count} jumpers."
        )
    return tuple(told)
