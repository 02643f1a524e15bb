"""The stages in order: the one place that knows it."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial

import numpy as np
from numpy.typing import NDArray

from .arrays import Floats, Mask
from .build import Build, Cut
from .building import Proof, prove_steps
from .colours import SurfaceColours, chosen_palette, surface_colours
from .errors import enough_memory
from .estimate import AGAIN, check_limits, estimate
from .layout import FILLER, lay, recolour_visible
from .layout.joining import add_ties
from .layout.learning import learned_table, samples_text
from .mesh import Repairs, TriangleMesh, check_any, model_scale, repair, scale_mesh, turn_upright
from .model import Bricks, Catalogue, ContactGraph, UnitGrid, contact_graph, load_catalogue
from .progress import Overall, Progress, part, silent
from .report import remarks, remarks_on_building, remarks_on_proof, remarks_on_split
from .settings import Settings
from .shell import hollow, make_cohesive
from .slicing import (
    Grid,
    Marks,
    Trajectories,
    adaptive_heights,
    differing_layers,
    fit_grid,
    levels_of,
    link_loops,
    slice_mesh,
)
from .statics import Stability, stability
from .supports import AssemblyPlan, Joint, add_bracing, add_pillars, plan_assembly, segment
from .texturing import reduce_images, remarks_on_unseen, seen_part
from .unit_bricks import (
    Detail,
    Offsets,
    add_backing,
    add_offset_bricks,
    dithering_of,
    facing_of,
    remarks_on_dithering,
    unit_bricks,
)
from .units import PLATES_PER_BRICK


@enough_memory()
def legorize(mesh: TriangleMesh, settings: Settings, progress: Progress = silent) -> Build:
    """Turn a textured mesh into a brick model.

    Parameters
    ----------
    mesh : TriangleMesh
        As read, in world mm.
    settings : Settings
    progress : Progress
        Told the stage at work, or what it is at, and the share of the whole run
        that is done, which never goes back.

    Returns
    -------
    Build

    Raises
    ------
    LegorizeError
        The mesh or the settings cannot be used, in one sentence.
    """
    catalogue = load_catalogue()
    palette, table = chosen_palette(settings.palette, catalogue), _table(settings)
    rng = np.random.default_rng(settings.seed)
    timings: dict[str, float] = {}
    expected = estimate(mesh, settings)
    check_limits(expected, settings)
    overall = Overall(expected.stages, progress)
    stage = partial(_stage, overall, timings)

    with stage("mesh"):
        mesh, repairs, turn, scale, unseen = _prepared(mesh, settings)
    with stage("colours"):
        surface = _surface(mesh, settings, palette, catalogue, rng)
    with stage("slicing"):
        frame = fit_grid(mesh, symmetric=settings.symmetric, plates=_in_plates(settings))
        cut = _cut(mesh, surface, frame, settings)
    with stage("trajectories"):
        trajectories = link_loops(mesh, cut.slices, surface, chord_deviation=settings.chord_deviation)
    with stage("unit bricks"):
        grid = _unit_grid(mesh, repairs, trajectories, surface, frame, cut, settings, palette, catalogue, overall)
    with stage("overhangs"):
        grid, offsets = _overhangs(grid, settings)
    with stage("hollowing"):
        shell = _hollowed(grid, settings, overall)
    with stage("layout"):
        shell, bricks = _laid(shell, settings, palette, table, catalogue, rng, overall)
    with stage("stability"):
        bricks, graph, found = _standing(bricks, settings, catalogue, overall)
    with stage("supports"):
        supports, joints = _supported(bricks, graph, settings, catalogue, overall)
    if len(supports.stays) > len(bricks):
        with stage("stability again"):
            graph = contact_graph(supports.stays, catalogue)
            found = stability(supports.stays, catalogue, graph, clutch=settings.clutch, progress=overall)
    bricks, proof = supports.stays, None
    if settings.prove_steps:
        with stage("proof"):
            proof = prove_steps(supports.steps, supports.bricks, catalogue, clutch=settings.clutch, progress=overall)
    overall.finish()
    made = (mesh, repairs, scale, turn, surface, cut, trajectories, offsets, grid, shell, bricks, graph, found)
    unseen = (*unseen, *remarks_on_dithering(mesh, settings.dithering))
    notes = (*repairs.sentences(), *unseen, *_notes(found, supports, proof, settings, catalogue))
    return Build(settings, *made, supports, joints, proof, notes, timings)


def _notes(
    found: Stability, supports: AssemblyPlan, proof: Proof | None, settings: Settings, catalogue: Catalogue
) -> tuple[str, ...]:
    """Return what a user has to know about bricks and building, a sentence each."""
    return (
        *remarks(supports.stays, found, catalogue),
        *remarks_on_building(supports, catalogue),
        *remarks_on_split(supports, most=settings.split),
        *remarks_on_proof(proof),
    )


def _in_plates(settings: Settings) -> bool:
    return settings.plates != "none"


def _prepared(mesh: TriangleMesh, settings: Settings) -> tuple[TriangleMesh, Repairs, Floats, float, tuple[str, ...]]:
    """Return the mesh as it is built, its repairs, turn and scale, and what has to be said of what is not seen."""
    mesh, repairs = repair(mesh)
    mesh, turn = turn_upright(mesh, settings.up)
    least, scale = settings.least_alpha, partial(_scale, settings=settings)
    mesh, repairs, share = seen_part(mesh, repairs, least=least, scale=scale)
    factor = scale(mesh)
    mesh = scale_mesh(mesh, factor)
    # where nothing is seen, all of it was taken
    mesh = reduce_images(mesh, least=least * (share < 1), mean=settings.fine_texture == "mean")
    return mesh, repairs, turn, factor, remarks_on_unseen(share, least=least)


def _scale(mesh: TriangleMesh, settings: Settings) -> float:
    return model_scale(
        mesh, size_by=settings.size_by, width=settings.width, height=settings.height, scale=settings.scale
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


def _cut(mesh: TriangleMesh, surface: SurfaceColours, frame: Grid, settings: Settings) -> Cut:
    """Cut the mesh at adaptive heights."""
    marks = differing_layers(mesh, frame, tolerance=settings.layer_difference) if _in_plates(settings) else None
    heights, layer, plate = adaptive_heights(
        mesh,
        ground=float(frame.origin[2]),
        n_layers=frame.n_layers,
        cusp=settings.cusp,
        colour=surface.of_faces(mesh),
        marked=_marked(marks, frame, settings),
    )
    return Cut(slice_mesh(mesh, heights), layer, plate, marks)


def _marked(marks: Marks | None, frame: Grid, settings: Settings) -> Mask | None:
    """Return the layers that are sliced plate by plate in any case."""
    if settings.plates == "all":
        return np.ones(frame.n_layers, dtype=bool)
    return None if marks is None else marks.any


def _unit_grid(
    mesh: TriangleMesh,
    repairs: Repairs,
    trajectories: Trajectories,
    surface: SurfaceColours,
    frame: Grid,
    cut: Cut,
    settings: Settings,
    palette: NDArray[np.int16],
    catalogue: Catalogue,
    progress: Progress,
) -> UnitGrid:
    """Return the unit bricks, of which there must be one at least."""
    lattice = frame.plates() if _in_plates(settings) else frame
    facing = facing_of(mesh, surface) if settings.backing else None
    grid = unit_bricks(
        mesh,
        trajectories,
        surface,
        lattice,
        levels=levels_of(cut.slices.heights, cut.layer, cut.plate, lattice),
        keep_thin=settings.keep_thin,
        longest=settings.cell_colour == "longest",
        catalogue=catalogue,
        closed=repairs.watertight,
        detail=_detail(cut.layer, frame, settings),
        facing=facing,
        dithering=dithering_of(settings.dithering, palette, mesh, surface, facing),
        progress=progress,
    )
    check_any(grid, mesh, keep_thin=settings.keep_thin)
    return grid if facing is None else add_backing(grid, facing, depth=settings.backing)


def _detail(layer: NDArray[np.int32], frame: Grid, settings: Settings) -> Detail | None:
    """Return where plates may stay: in layers of three slices, and where they pay unless all were asked for."""
    if not _in_plates(settings):
        return None
    marked = np.bincount(layer, minlength=frame.n_layers) == PLATES_PER_BRICK
    if settings.plates == "all":
        return Detail(marked, 0.0)
    return Detail(marked, settings.plate_gain, settings.fewer_parts)


def _overhangs(grid: UnitGrid, settings: Settings) -> tuple[UnitGrid, Offsets]:
    """Return the cells with the colours of offset bricks, and those."""
    return add_offset_bricks(
        grid,
        plates=_in_plates(settings),
        critical_angle=settings.critical_angle,
        literal=settings.cell_colour == "longest",
    )


def _hollowed(grid: UnitGrid, settings: Settings, progress: Progress) -> UnitGrid:
    """Return what must and what may be built, and holds together."""
    # behind a picture, the first row or layer of its backing has to stay
    shell = settings.shell + bool(settings.backing)
    shell_alone = hollow(
        grid,
        shell=shell if settings.hollow else None,
        rule=settings.hollow_rule,
        ceilings=settings.ceilings,
        open_bottom=settings.open_bottom,
        progress=part(progress, 0.0, 0.8),
    )
    progress("hollowing", 0.8)
    return make_cohesive(shell_alone, plates=_in_plates(settings))


def _laid(
    shell: UnitGrid,
    settings: Settings,
    palette: NDArray[np.int16],
    table: Mask | None,
    catalogue: Catalogue,
    rng: np.random.Generator,
    progress: Progress,
) -> tuple[UnitGrid, Bricks]:
    """Lay the bricks and join what is loose; return them with the cells as they are laid."""
    bricks = lay(
        shell,
        catalogue=catalogue,
        rng=rng,
        tier=settings.layout,
        learned=settings.learned,
        table=table,
        filler=_filler(palette, catalogue),
        progress=part(progress, 0.0, 0.97),
    )
    progress("layout", 0.97)
    bricks, shell = add_ties(bricks, shell, catalogue, plates=_in_plates(settings))
    return shell, recolour_visible(bricks, shell, contact_graph(bricks, catalogue), catalogue)


def _standing(
    bricks: Bricks, settings: Settings, catalogue: Catalogue, progress: Progress
) -> tuple[Bricks, ContactGraph, Stability]:
    """Test the bricks by force, with pillars under what floats or falls if there may be supports."""
    graph = contact_graph(bricks, catalogue)
    tested = partial(stability, catalogue=catalogue, clutch=settings.clutch, progress=progress)
    if settings.supports == "none":
        return bricks, graph, tested(bricks, graph=graph)
    bricks, graph = add_pillars(bricks, catalogue, graph)
    found = tested(bricks, graph=graph)
    return add_bracing(bricks, catalogue, graph, found, clutch=settings.clutch, progress=progress)


def _supported(
    bricks: Bricks, graph: ContactGraph, settings: Settings, catalogue: Catalogue, progress: Progress
) -> tuple[AssemblyPlan, tuple[Joint, ...]]:
    """Cut the model into pieces, put supports under them, and find the building order."""
    progress("supports", 0.0)
    bricks, joints = segment(bricks, catalogue, graph, most=settings.split, deepest=settings.hanging)
    supports = plan_assembly(
        bricks, catalogue, wish=settings.supports, deepest=settings.hanging, clutch=settings.clutch, progress=progress
    )
    return supports, joints


def _table(settings: Settings) -> Mask | None:
    """Return the exchanges that were learned from the user's own samples, if they are asked for."""
    if not settings.learned_from:
        return None
    if settings.layout == "fast" and settings.learned:
        return learned_table(settings.learned_from)
    # a wrong file is told of now, not when another layout is chosen
    samples_text(settings.learned_from)
    return None


def _filler(palette: NDArray[np.int16], catalogue: Catalogue) -> int:
    """Return the colour of bricks that nobody sees: the usual one, or that of the palette in which most parts exist."""
    if FILLER in palette:
        return FILLER
    made = catalogue.exists_in(np.arange(len(catalogue.parts))[:, None], palette).sum(axis=0)
    return int(palette[made.argmax()])


@contextmanager
def _stage(overall: Overall, timings: dict[str, float], name: str) -> Iterator[None]:
    """Announce a stage and note its CPU seconds; what is done again counts to what it repeats."""
    shown = name.removesuffix(AGAIN)
    start = time.process_time()
    with overall.stage(name, shown=shown):
        yield
    timings[shown] = timings.get(shown, 0.0) + time.process_time() - start
