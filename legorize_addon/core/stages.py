"""What the settings mean for each stage: the step from them to the functions of the packages."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, Final, cast

import numpy as np
from numpy.typing import NDArray

from .arrays import Floats, Mask
from .build import Cut
from .colours import Dominant, SurfaceColours, count_texels, image_colours
from .layout import Alike, Manner, lay, lay_learned
from .layout.learning import FillLog
from .mesh import Repairs, TriangleMesh, check_any, emphasised, model_scale, repair, scale_mesh, turn_upright
from .model import COLOUR_ANY, Assembly, Bricks, Catalogue, Fill, UnitGrid
from .progress import Progress, silent
from .run import Run
from .settings import Settings
from .shell import hollow, make_cohesive
from .slicing import (
    LEEWAY,
    Grid,
    Marks,
    Trajectories,
    adaptive_heights,
    best_grid,
    differing_layers,
    fit_grid,
    levels_of,
    link_loops,
    slice_mesh,
)
from .supports import (
    INSIDE_COLOUR,
    AssemblyPlan,
    Joint,
    Wish,
    of_the_paper,
    parts_of_supports,
    pays,
    plan_assembly,
    segment,
)
from .texturing import reduce_images, remarks_on_unseen, seen_part, with_features
from .unit_bricks import (
    Detail,
    Facing,
    Offsets,
    Raster,
    Rules,
    WantedColours,
    add_backing,
    add_offset_bricks,
    dithering_of,
    facing_of,
    unit_bricks,
    wanted_colours,
)
from .units import PLATES_PER_BRICK

CUTS: Final = 4
"""Ways to cut a model that are planned with all supports, where those before saved too few: each takes a whole plan."""


def _in_plates(settings: Settings) -> bool:
    return settings.plates != "none"


def prepare_mesh(run: Run, mesh: TriangleMesh) -> tuple[TriangleMesh, Repairs, Floats, float, tuple[str, ...]]:
    """Return the mesh as it is built, its repairs, turn and scale, and remarks on what was not seen or weighted."""
    settings = run.settings
    mesh, repairs = repair(mesh)
    mesh, turn = turn_upright(mesh, settings.up)
    least, scale = settings.least_alpha, partial(_scale, settings=settings)
    mesh, repairs, share = seen_part(mesh, repairs, least=least, scale=scale)
    factor = scale(mesh)
    mesh = emphasised(scale_mesh(mesh, factor), settings.emphasis if settings.weight else 0.0)
    # where nothing can be seen, all of it was used
    mesh = reduce_images(mesh, least=least * (share < 1), mean=settings.fine_texture == "mean")
    mesh = with_features(mesh, settings.features, settings.emphasis)
    told = remarks_on_unseen(share, least=least)
    if settings.weight and settings.emphasis and mesh.weight is None:
        told += (f"The weight {settings.weight!r} is 0 everywhere: no part of the surface counts more than others.",)
    return mesh, repairs, turn, factor, told


def place_grid(run: Run, mesh: TriangleMesh, scale: float) -> tuple[TriangleMesh, float, Grid, tuple[str, ...]]:
    """Lay the grid over a mesh; return both, the scale, and a remark if the size changed, where that is allowed."""
    settings, plates = run.settings, _in_plates(run.settings)
    if settings.grid_fit == "none":
        return mesh, scale, fit_grid(mesh, symmetric=settings.symmetric, plates=plates), ()
    # a factor is meant as it is given, and sizes by counting are searched by it
    leeway = LEEWAY if settings.grid_fit == "sizes" and settings.size_by != "scale" else 0.0
    frame, factor = best_grid(mesh, symmetric=settings.symmetric, plates=plates, leeway=leeway)
    if factor == 1:
        return mesh, scale, frame, ()
    way = "larger" if factor > 1 else "smaller"
    by = f"{100 * abs(factor - 1):.0f} % {way}"
    told = f"The model is {by} than asked for, because its surface fits the studs better."
    return scale_mesh(mesh, factor), scale * factor, frame, (told,)


def _scale(mesh: TriangleMesh, settings: Settings) -> float:
    return model_scale(
        mesh,
        size_by=settings.size_by,
        width=settings.width,
        height=settings.height,
        scale=settings.scale,
        cm=settings.cm,
    )


def find_colours(run: Run, mesh: TriangleMesh, given: TriangleMesh) -> SurfaceColours:
    """Return the brick colours of all texels; one to one, no more of them than the palette has.

    Where every texel counts once, these are the texels of the mesh that was
    given that alpha does not hide.
    """
    found = run.once(find_dominant, mesh, given)
    return found.as_bricks(run.catalogue, palette=run.palette, one_to_one=run.settings.one_to_one)


def find_dominant(run: Run, mesh: TriangleMesh, given: TriangleMesh) -> Dominant:
    """Return the dominant colours of all texels that count."""
    settings = run.settings
    every = settings.sampling == "image"
    return image_colours(
        mesh,
        n_colours=min(settings.colours, len(run.palette)) if settings.one_to_one else settings.colours,
        rng=run.rng,
        texels=count_texels(given.images, given.opacities, least=settings.least_alpha or 0.5) if every else None,
    )


def cut_mesh(run: Run, mesh: TriangleMesh, surface: SurfaceColours, frame: Grid) -> Cut:
    """Cut the mesh at adaptive heights."""
    settings = run.settings
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


def link_slices(run: Run, mesh: TriangleMesh, cut: Cut, surface: SurfaceColours) -> Trajectories:
    """Return the coloured loops of the slices."""
    return link_loops(mesh, cut.slices, surface, chord_deviation=run.settings.chord_deviation)


def make_unit_grid(
    run: Run,
    mesh: TriangleMesh,
    repairs: Repairs,
    trajectories: Trajectories,
    surface: SurfaceColours,
    frame: Grid,
    cut: Cut,
) -> UnitGrid:
    """Return the unit bricks, at least one."""
    settings = run.settings
    lattice = frame.plates() if _in_plates(settings) else frame
    facing = facing_of(mesh, surface) if settings.backing else None
    rules = Rules(
        symmetric=settings.symmetric,
        keep_thin=settings.keep_thin,
        longest=settings.cell_colour == "longest",
        closed=repairs.watertight,
        detail=_detail(cut.layer, frame, settings),
        facing=facing,
        specks=settings.keep_specks,
        dithering=dithering_of(settings.dithering, run.palette, mesh, surface, facing),
    )
    raster = Raster(lattice, levels_of(cut.slices.heights, cut.layer, cut.plate, lattice))
    grid = unit_bricks(mesh, trajectories, surface, raster, rules, catalogue=run.catalogue, progress=run.progress)
    check_any(grid, mesh, keep_thin=settings.keep_thin)
    return grid if facing is None else add_backing(grid, facing, depth=settings.backing)


def find_wanted(run: Run, mesh: TriangleMesh, surface: SurfaceColours, grid: UnitGrid) -> WantedColours:
    """Return what the surface asks for at every cell, which the cells' own colours do not change."""
    facing = facing_of(mesh, surface) if run.settings.backing else None
    return run.once(light_on_cells, mesh, grid.solid, grid.origin, facing)


def light_on_cells(run: Run, mesh: TriangleMesh, solid: Mask, origin: Floats, facing: Facing | None) -> WantedColours:
    """Return the light of the surface on solid cells."""
    return wanted_colours(mesh, solid, origin, plates=_in_plates(run.settings), facing=facing)


def _detail(layer: NDArray[np.int32], frame: Grid, settings: Settings) -> Detail | None:
    """Return where plates may stay: in layers of three slices, and only where they pay unless all are wanted."""
    if not _in_plates(settings):
        return None
    marked = np.bincount(layer, minlength=frame.n_layers) == PLATES_PER_BRICK
    if settings.plates == "all":
        return Detail(marked, 0.0)
    return Detail(marked, settings.plate_gain, settings.fewer_parts, middle=settings.superposition == "middle")


def close_overhangs(run: Run, grid: UnitGrid) -> tuple[UnitGrid, Offsets]:
    """Return the cells with the colours of offset bricks, and those."""
    return add_offset_bricks(
        grid,
        plates=_in_plates(run.settings),
        critical_angle=run.settings.critical_angle,
        literal=run.settings.cell_colour == "longest",
    )


def hollow_out(run: Run, grid: UnitGrid) -> UnitGrid:
    """Return the required and the optional cells of a shell that hangs together."""
    return make_cohesive(hollow_by(run.settings, grid, run.progress), plates=_in_plates(run.settings))


def hollow_by(settings: Settings, grid: UnitGrid, progress: Progress = silent) -> UnitGrid:
    """Return the required and the optional cells, as settings ask for them."""
    # behind a picture, the first row or layer of its backing has to stay
    shell = settings.shell + bool(settings.backing)
    return hollow(
        grid,
        shell=shell if settings.hollow else None,
        rule=settings.hollow_rule,
        ceilings=settings.ceilings,
        open_bottom=settings.open_bottom,
        pillar_colour=INSIDE_COLOUR if settings.support_parts == "paper" else COLOUR_ANY,
        progress=progress,
    )


def lay_freely(run: Run, shell: UnitGrid) -> Bricks:
    """Lay the bricks, whether the model is symmetric or not; note what a machine decided."""
    settings, log = run.settings, FillLog()
    way: Callable[..., Bricks]
    if settings.layout == "learned":
        way = partial(lay_learned, learned_from=settings.learned_from if run.training else "", log=log)
    else:
        way = partial(lay, tier=settings.layout, exchanges=run.exchanges)
    bricks = run.parts.laid(partial(way, shell, rng=run.rng, filler=run.filler, progress=run.progress))
    if settings.layout == "learned":
        run.learning[:] = log.sentences(shell, sum(run.timings.values()), len(bricks))
    return bricks


def lay_bricks(run: Run, shell: UnitGrid) -> tuple[Bricks, UnitGrid]:
    """Lay the bricks, and the halves of a symmetric model alike; return the cells that they cover as well."""
    run.parts.check_volume(int(np.count_nonzero(shell.cover == Fill.REQUIRED)))
    bricks = run.once(lay_freely, shell)
    if run.settings.layout == "learned":
        # the energies of its machine have the mirror images
        return bricks, shell
    # where parts differ in price or weight, or few are owned, their number does not say what a layout costs
    if not run.settings.symmetric or run.parts.minds_lots:
        return bricks, shell
    return _alike(run, shell).better(bricks, run.once(lay_halves, shell))


def lay_halves(run: Run, shell: UnitGrid) -> tuple[Bricks, UnitGrid] | None:
    """Lay the halves of a symmetric model alike, whatever that costs; return the cells that they cover as well."""
    return _alike(run, shell).offer(run.progress)


def _alike(run: Run, shell: UnitGrid) -> Alike:
    manner, burden = Manner(cast("Any", run.settings.layout), run.exchanges), partial(_parts_of_supports, run)
    return Alike(shell, run.parts.catalogue, rng=run.rng, manner=manner, filler=run.filler, burden=burden)


def _parts_of_supports(run: Run, bricks: Bricks) -> float:
    """Return about how many parts supports of a layout take."""
    if not run.settings.supported:
        return 0.0
    return parts_of_supports(Assembly(bricks, run.catalogue), deepest=run.settings.hanging)


def cut_pieces(
    run: Run, assembly: Assembly, barred: frozenset[int] = frozenset()
) -> tuple[Assembly, tuple[Joint, ...]]:
    """Cut the model into pieces where that is expected to save supports, but for cuts at barred levels."""
    return segment(assembly, most=run.settings.split, deepest=run.settings.hanging, barred=barred)


def plan_pieces(
    run: Run, whole: Assembly, cut: Assembly, joints: tuple[Joint, ...], kinds: NDArray[np.uint8] | None = None
) -> tuple[AssemblyPlan, tuple[Joint, ...]]:
    """Plan a model in pieces, or with other cuts where the supports that are laid turn out to save too little.

    Parameters
    ----------
    run : Run
    whole, cut : Assembly
        The model in one piece, and as :func:`cut_pieces` cuts it.
    joints : tuple of Joint
        Its joints.
    kinds : (n_layers, n_y, n_x) uint8 array, optional
        The half studs of cells, for :func:`make_plan`.

    Returns
    -------
    plan : AssemblyPlan
    joints : tuple of Joint
        None where no cut pays.
    """
    plan = run.once(make_plan, cut, kinds)
    if not joints or not run.settings.supported:
        return plan, joints
    alone, barred = run.once(make_plan, whole, kinds), frozenset[int]()
    for left in reversed(range(CUTS)):
        # what is left in the air either way weighs more than any support
        hanging, before = (len(each.walk.in_air) for each in (plan, alone))
        if hanging < before or (hanging == before and pays(len(alone.removed), len(plan.removed))):
            return plan, joints
        if not left:
            break
        barred |= {joints[-1].level}
        cut, joints = run.once(cut_pieces, whole, barred)
        if not joints:
            break
        plan = run.once(make_plan, cut, kinds)
    return alone, ()


def make_plan(run: Run, assembly: Assembly, kinds: NDArray[np.uint8] | None = None) -> AssemblyPlan:
    """Put supports under the pieces, find the building order, and take the parts from those that are owned.

    Supports of bricks with some half studs keep off those with others, if these are given.
    """
    settings, few = run.settings, run.settings.support_parts == "paper"
    planned = partial(plan_assembly, deepest=settings.hanging, clutch=settings.clutch, long_bricks=few, kinds=kinds)

    def plan(catalogue: Catalogue | None, wish: Wish) -> AssemblyPlan:
        """Plan with supports of a kind, and of the parts of a catalogue if there is one."""
        catalogue = of_the_paper(catalogue or run.catalogue) if few else catalogue
        model = assembly if catalogue is None else Assembly(assembly.bricks, catalogue)
        return planned(model, wish=wish, progress=run.progress, recall=run.recall)

    return run.parts.supplied(plan, settings.supports)
