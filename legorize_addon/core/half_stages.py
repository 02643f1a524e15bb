"""What the settings mean for half studs: where they are, which jumpers lie there, and whether all holds in the end."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from .build import Build, Draft
from .building import still_alike
from .errors import SettingsError
from .half_studs import (
    NEEDED,
    HalfStudsError,
    Halves,
    check_apart,
    choose_regions,
    draw_together,
    find_islands,
    grid_together,
    halves_in,
    halves_of,
    lay_jumpers,
    lies_in_several,
    set_apart,
)
from .layout import with_fixed
from .mesh import TriangleMesh
from .model import Assembly, Bricks, Catalogue, UnitGrid, concatenate
from .progress import Progress, part
from .run import Run
from .settings import Settings
from .slicing import Grid
from .slope_stages import find_slopes
from .slopes import Slopes
from .statics import Stability
from .strength import check_final
from .supports import AssemblyPlan, walk_apart
from .units import count_of

Barred = tuple[tuple[int, int, bool, int], ...]
"""Keys of regions that there must not be."""


def find_regions(run: Run, mesh: TriangleMesh, frame: Grid, barred: Barred) -> tuple[TriangleMesh, Grid, Halves | None]:
    """Find the regions in which half studs pay; return the mesh drawn together there, and its grid."""
    settings = run.settings
    if not settings.half_studs:
        return mesh, frame, None
    parts = run.parts.joining
    if not all(parts.exists[parts.part_row(number)].any() for number in NEEDED):
        raise SettingsError(
            f"half_studs is on, but the parts that may be laid do not have all of {', '.join(NEEDED)}: turn half_studs "
            "off, or allow other parts."
        )
    islands = find_islands(mesh, frame)
    choice = choose_regions(islands, price=settings.slope_price, anywhere=True, barred=frozenset(barred))
    together = grid_together(frame, choice)
    if not choice.regions:
        return mesh, together, None
    mesh = draw_together(mesh, float(frame.origin[2]), islands, halves_of(choice, islands))
    halves = halves_in(together, islands, choice)
    return mesh, replace(together, moved=halves.half ^ np.uint8(halves.rest)), halves


def given_bricks(run: Run, made: Draft) -> tuple[Draft, Slopes | None]:
    """Return what lies in the cells before the other bricks are laid, jumpers and slopes, and the cells for it."""
    given = None
    if made.halves is not None:
        with run.stage("surface"):
            check_apart(made.hollow.solid, made.halves)
            jumpers, cells = run.once(_find_jumpers, made, made.halves)
            # a jumper has to stay
            rows, stays = np.arange(len(jumpers)), np.ones(len(jumpers), bool)
            given = Slopes(jumpers, np.full(len(jumpers), np.inf), -1 - rows, stays, made.grid.solid)
            made = replace(made, hollow=cells)
    if run.settings.surface == "slopes":
        with run.stage("surface"):
            given = run.once(_join_slopes, given, run.once(find_slopes, made), made.halves)
    return made, given


def _find_jumpers(run: Run, made: Draft, halves: Halves) -> tuple[Bricks, UnitGrid]:
    """Lay the jumpers of a model; return its cells as well."""
    parts = run.parts.joining
    # in colours that the model has, where there are such
    known = parts.exists & np.isin(parts.codes, [*run.palette.tolist(), *np.unique(made.hollow.colour).tolist()])
    parts = replace(parts, exists=np.where(known.any(axis=1)[:, None], known, parts.exists))
    jumpers, cells = lay_jumpers(made.hollow, halves, parts, filler=run.filler)
    return jumpers, with_fixed(cells, jumpers, run.catalogue)


def _join_slopes(run: Run, jumpers: Slopes | None, slopes: Slopes, halves: Halves | None) -> Slopes:
    """Return jumpers, if there are any, and the slopes that do not reach from one region into another."""
    if jumpers is None or halves is None:
        return slopes
    whole = ~lies_in_several(Assembly(slopes.bricks, run.catalogue), halves)
    return Slopes(
        concatenate([jumpers.bricks, slopes.bricks.take(whole)]),
        np.concatenate([jumpers.worth, slopes.worth[whole]]),
        np.concatenate([jumpers.pair, slopes.pair[whole]]),
        np.concatenate([jumpers.dear, slopes.dear[whole]]),
        slopes.solid,
    )


def lie_apart(run: Run, plan: AssemblyPlan, halves: Halves, found: Stability) -> tuple[AssemblyPlan, Stability]:
    """Set all bricks of a plan apart; test the order of building and the forces anew.

    Raises
    ------
    HalfStudsError
        Something holds no longer that held while the model was drawn together, or equal submodels differ.
    """
    apart = walk_apart(plan, set_apart(plan.assembly, halves))
    # submodels that are equal on one grid are written once
    if (plan.walk.buildable and not apart.walk.buildable) or not still_alike(apart.steps, apart.assembly.bricks):
        raise HalfStudsError(halves.regions)
    tested = check_final(run, apart.final)
    if (found.stable and not tested.stable) or (found.stands and not tested.stands):
        raise HalfStudsError(halves.regions)
    return apart, tested


def with_half_studs(
    make: Callable[[Barred, TriangleMesh, Settings, Progress], Build],
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
        With a remark on regions that were given up.
    """
    barred: Barred = ()
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
            barred = tuple(sorted({*barred, *(region.key for region in error.regions)}))
            continue
        return replace(build, notes=(*build.notes, *_given_up(barred)))


def _given_up(barred: Barred) -> tuple[str, ...]:
    """Say at which layers there are no half studs although they would pay."""
    if not barred:
        return ()
    at = {max(low, 1) if upwards else high + 1 for low, high, upwards, _ in barred}
    layers = ", ".join(map(str, sorted(at)))
    return (
        f"Half studs were given up at layer {layers}: with them something would rest on supports across the "
        "jumpers, collide, or not hold.",
    )


def remarks_on_half_studs(halves: Halves | None, bricks: Bricks, catalogue: Catalogue) -> tuple[str, ...]:
    """Say what lies half a stud off the rest."""
    if halves is None:
        return ()
    jumpers = int(np.count_nonzero(np.array([each.jumper for each in catalogue.parts])[bricks.part]))
    told = []
    for region in halves.regions:
        if not any(region.half):
            # part of another region lies on the studs of the rest again
            continue
        ways = " and ".join(axis for axis, by in zip("xy", region.half, strict=True) if by)
        above = f"above layer {region.low}" if region.low else "from the ground up"
        way = above if region.upwards else f"up to layer {region.high + 1}"
        told.append(f"A part {way} lies half a stud aside along {ways}.")
    return (*told, f"{count_of(jumpers, 'jumper holds', 'jumpers hold')} what lies half a stud aside.")
