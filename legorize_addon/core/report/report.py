"""What was built, in plain numbers and words, for ``report.json``."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any, Final

import numpy as np

from ..arrays import Floats, Mask
from ..build import Build, Cut
from ..building import Kind
from ..errors import enough_memory
from ..files import ldraw_matrix
from ..measures import corner_windings, lower_bound, pass_through_types
from ..model import NOBODY, SUPPORTS, Assembly, Catalogue, ContactGraph, Fill, Role, UnitGrid, brick_columns
from ..progress import Progress, silent
from ..shell import free_bodies, tally_cases
from ..shopping import Lot, ShoppingList, not_made, shopping_list
from ..slicing import cut_at_grid
from ..supports import AssemblyPlan
from ..unit_bricks import Offsets, OverhangKind, overhang_kinds
from ..units import PLATES_PER_BRICK
from .money import price_facts
from .remarks import remarks

SCHEMA: Final = 2
"""Version of the keys; raised when one of them changes its meaning."""


@enough_memory()
def report(
    build: Build,
    catalogue: Catalogue,
    *,
    version: str,
    mm_per_unit: float,
    with_bound: bool = False,
    progress: Progress = silent,
) -> dict[str, Any]:
    """Describe a build.

    Parameters
    ----------
    build : Build
        A finished build.
    catalogue : Catalogue
        Its parts and colours.
    version : str
        Version of the add-on.
    mm_per_unit : float
        World mm per unit of length in the scene the mesh came from.
    with_bound : bool, optional
        Whether to prove how few bricks any layout needs, which may take longer
        than the layout itself.
    progress : Progress, optional
        Told how far that proof is.

    Returns
    -------
    dict
        Strings, numbers, lists and dictionaries only, ready for ``json.dumps``.
        ``mesh_to_ldraw`` is the row-major 4 x 4 transform from coordinates of
        that scene to LDU; ``hollow_ratio`` the share of the model's cells that
        no brick fills, supports excluded. ``pass_through`` counts the paper's types
        of cells slice by slice, ``offsets`` and ``overhangs`` count by levels, of
        plates or of bricks, ``hollowing`` by cells a plate high. What was not
        computed is None: in ``layout`` ``fewest_possible`` and
        ``at_most_more_percent`` without the bound, in ``detail`` the marks of a
        model without plates, in ``building`` the ``proof`` that was not asked for.

    Raises
    ------
    BuildError
        A brick has a colour that is not in the catalogue.
    """
    wanted = shopping_list(Assembly(build.bricks, catalogue), moves=len(build.supports.moves))
    levels, supports = _levels(build), build.supports
    return {
        "schema": SCHEMA,
        "version": version,
        "seed": build.settings.seed,
        "settings": asdict(build.settings),
        "input": _input(build),
        "mesh_to_ldraw": _mesh_to_ldraw(build, mm_per_unit).tolist(),
        "scale": build.scale,
        "grid": _grid(build.grid),
        "pass_through": _pass_through(build),
        "detail": _detail(build.cut, build.grid),
        "offsets": _offsets(build.offsets),
        "overhangs": _overhangs(levels),
        "hollowing": _hollowing(build, levels),
        "counts": _counts(build, catalogue, wanted.lots),
        "mass_g": round(wanted.mass, 2),
        "size": _size(wanted),
        "building_time_s": round(wanted.seconds),
        "hollow_ratio": round(hollow_ratio(build), 4),
        "layout": _layout(build, catalogue, progress if with_bound else None),
        "price": price_facts(build, catalogue, progress if with_bound else None),
        "bodies": free_bodies(build.hollow),
        "connection": _connection(build.graph),
        "stability": _stability(build, catalogue),
        "buildable_steps": supports.walk.n_steps - len(supports.walk.bad_steps),
        "building": _building(build),
        "supports": _supports(supports, catalogue),
        "unavailable_part_colours": _pairs(not_made(wanted.lots)),
        "unknown_elements": _pairs([lot for lot in wanted.lots if not lot.element]),
        "timings_s": {stage: round(seconds, 4) for stage, seconds in build.timings.items()},
        "notes": list(build.notes),
    }


def hollow_ratio(build: Build) -> float:
    """Return the share of a model's cells that no brick fills, supports excluded."""
    return 1 - _filled(build) / int(build.grid.solid.sum())


def _input(build: Build) -> dict[str, Any]:
    repairs = asdict(build.repairs)
    return {
        "triangles": len(build.mesh.faces),
        "images": len(build.mesh.images),
        "watertight": repairs.pop("watertight"),
        "repairs": repairs,
    }


def _mesh_to_ldraw(build: Build, mm_per_unit: float) -> Floats:
    turn = build.turn.copy()
    turn[:3, 3] /= mm_per_unit
    return ldraw_matrix(build.grid.origin, build.scale, mm_per_unit) @ turn


def _grid(grid: UnitGrid) -> dict[str, int]:
    """Return the extent of the model in studs and layers."""
    layer, _, y, x = np.nonzero(grid.solid)
    return {"x": int(np.ptp(x)) + 1, "y": int(np.ptp(y)) + 1, "layers": int(np.ptp(layer)) + 1}


def _pass_through(build: Build) -> dict[str, int]:
    """Return how many cells trajectories pass such that one, two or three corners lie inside, over all slices."""
    loops, corner = build.trajectories, build.grid.origin[:2]
    level = loops.loop_slice[loops.edge_loop].astype(np.int64)
    n_levels, (n_y, n_x) = len(build.cut.slices.heights), build.grid.colour.shape[2:]
    windings = corner_windings(loops.points, loops.ends, level, corner=corner, n_levels=n_levels, n_y=n_y, n_x=n_x)
    pieces = cut_at_grid(loops.points, loops.ends, corner)
    _, inside = pass_through_types(pieces, level[pieces.edge], windings)
    return {f"type_{number}": int((inside == number).sum()) for number in (1, 2, 3)}


def _levels(build: Build) -> Mask:
    """Return the solid model in levels of plates or of bricks, as overhangs were looked for, without empty rims."""
    solid = build.grid.solid
    one_brick = len(build.offsets.ring) == len(solid)
    levels = solid[:, 0] if one_brick else solid.reshape(-1, *solid.shape[2:])
    used = [np.flatnonzero(levels.any(axis=others)) for others in ((0, 2), (0, 1))]
    y, x = (slice(rows.min(initial=0), rows.max(initial=-1) + 1) for rows in used)
    return levels[:, y, x]


def _detail(cut: Cut, grid: UnitGrid) -> dict[str, int | None]:
    """Return how many layers differ, were sliced plate by plate, and have columns that are not one brick."""
    plates = grid.solid.any(axis=1) & ~brick_columns(grid)[0]
    layers = len(grid.colour)
    marked = {
        f"marked_by_{name}": None if cut.marks is None else int(getattr(cut.marks, name).sum())
        for name in ("number", "length", "area")
    }
    return {
        "layers": layers,
        **marked,
        "sliced_in_plates": int((np.bincount(cut.layer, minlength=layers) == PLATES_PER_BRICK).sum()),
        "layers_in_plates": int(plates.any(axis=(1, 2)).sum()),
        "columns_of_plates": int(plates.sum()),
    }


def _offsets(offsets: Offsets) -> dict[str, int]:
    return {
        "trajectories": int(offsets.trajectories.sum()),
        "bricks": int(offsets.cells.sum()),
        "left_alone": int(offsets.left_alone.sum()),
    }


def _overhangs(levels: Mask) -> dict[str, int]:
    found = overhang_kinds(levels)
    return {kind.name.lower(): found.count(kind) for kind in OverhangKind}


def _hollowing(build: Build, levels: Mask) -> dict[str, Any]:
    """Return the cells that must and may be built, those of the solid model, and the cases of the paper's regions."""
    cover = build.hollow.cover
    return {
        "must": int((cover == Fill.REQUIRED).sum()),
        "may": int((cover == Fill.OPTIONAL).sum()),
        "solid": int(build.grid.solid.sum()),
        "cases": asdict(tally_cases(levels, upper_only=build.settings.hollow_rule == "upper")),
    }


def _counts(build: Build, catalogue: Catalogue, lots: Sequence[Lot]) -> dict[str, Any]:
    bricks = build.bricks
    by_part, by_colour = Counter[str](), Counter[str]()
    for lot in lots:
        by_part[lot.part.number] += lot.count
        by_colour[str(lot.colour.code)] += lot.count
    plate = np.array([part.height == 1 for part in catalogue.parts])
    return {
        "bricks": len(bricks),
        "plates": int(plate[bricks.part].sum()),
        "support_outside": len(build.supports.removed) + int((bricks.role == Role.SUPPORT_KEPT).sum()),
        "support_inside": int((bricks.role == Role.SUPPORT_INSIDE).sum()),
        "unit_bricks_before": int(build.grid.solid.any(axis=1).sum()),
        "by_part": dict(by_part),
        "by_colour": dict(sorted(by_colour.items(), key=lambda entry: int(entry[0]))),
    }


def _filled(build: Build) -> int:
    """Return the number of the model's cells that bricks fill, other than supports; some bricks fill further cells."""
    owner, low = build.graph.owner, build.graph.low
    support = np.isin(build.bricks.role, SUPPORTS)
    cell = np.argwhere(owner != NOBODY)
    cell = cell[~support[owner[tuple(cell.T)]]] + low[::-1]
    solid = build.grid.solid.reshape(-1, *build.grid.solid.shape[2:])
    within = ((cell >= 0) & (cell < solid.shape)).all(axis=1)
    return int(solid[tuple(cell[within].T)].sum())


def _connection(graph: ContactGraph) -> dict[str, int]:
    return {
        "components": graph.n_components,
        "floating": graph.n_floating,
        "collisions": graph.collisions,
    }


def _layout(build: Build, catalogue: Catalogue, proving: Progress | None) -> dict[str, Any]:
    """Return how near the number of bricks is to the proven bound, unless nobody waits for the proof.

    The bound holds for every layout of the same cells and colours, with the same
    columns laid in bricks and in plates.
    """
    fewest = None if proving is None else lower_bound(build.hollow, catalogue, progress=proving)
    return {
        "tier": build.settings.layout,
        "fewest_possible": fewest,
        "at_most_more_percent": None if fewest is None else round(100 * (len(build.bricks) / max(fewest, 1) - 1), 2),
    }


def _stability(build: Build, catalogue: Catalogue) -> dict[str, Any]:
    """Return the verdict with its reasons, and whether its proof was confirmed by a check apart from the search."""
    found = build.stability
    enough = found.enough_clutch
    return {
        "verdict": found.verdict.value,
        "stable": found.stands,
        "by_studs_alone": found.stable,
        "spare_wanted": build.settings.spare,
        "reasons": list(remarks(Assembly(build.bricks, catalogue), found, spare=build.settings.spare)),
        "components": build.graph.n_components,
        "worst_margin": round(float(found.margin.min(initial=1.0)), 4),
        "failing": int((found.margin < 0).sum()),
        "weakest": [int(row) for row in found.weakest(5)],
        "clutch_n": build.settings.clutch,
        "enough_clutch_n": round(enough, 4) if np.isfinite(enough) else None,
        "residual_n": float(f"{found.residual:.3g}"),
        "proof_confirmed": found.check(),
    }


def _building(build: Build) -> dict[str, Any]:
    """Return the figures of the building order, and what its check found."""
    supports, found = build.supports, build.supports.walk
    return {
        "steps": found.n_steps,
        "moves": len(supports.moves),
        "buildable": found.buildable,
        "pressed_from_below": int(supports.moves.pressed.sum()),
        "in_air": len(found.in_air),
        "squeezed_in": len(found.squeezed),
        "covered": len(found.covered),
        "pressed_without_room": len(found.cramped),
        "sub_assemblies": sum(each.kind == Kind.SUBASSEMBLY for each in supports.steps.submodels),
        "loose_pieces": len(found.loose_pieces),
        "held_by_hand": len(supports.unsteady),
        "ends_as_model": len(found.wrong_end) == 0,
        "pieces": len(supports.pieces),
        "components_of_pieces": _components(supports),
        "joints": [asdict(joint) for joint in build.joints],
        "proof": None
        if build.proof is None
        else {
            "steps": len(build.proof.steps),
            "collapsing": (build.proof.collapsing + 1).tolist(),
            "undecided": (build.proof.undecided + 1).tolist(),
        },
    }


def _components(supports: AssemblyPlan) -> list[int]:
    """Return in how many parts the finished bricks of each piece fall apart: one each, if it is a piece."""
    final = supports.final
    pieces = (final.take(final.bricks.piece == piece) for piece in np.unique(final.bricks.piece).tolist())
    return [piece.graph.n_components for piece in pieces]


def _supports(supports: AssemblyPlan, catalogue: Catalogue) -> dict[str, Any]:
    """Return the figures of the supports: those that are taken out, and those that stay."""
    removed, stays = supports.removed, supports.final.bricks
    return {
        "ways": [piece.plan.way for piece in supports.pieces],
        "removed": len(removed),
        "removed_mass_g": round(float(catalogue.mass[removed.part].sum()), 2),
        "kept_outside": int((stays.role == Role.SUPPORT_KEPT).sum()),
        "kept_inside": int((stays.role == Role.SUPPORT_INSIDE).sum()),
        "bricks_in_need": sum(len(piece.need.bricks) for piece in supports.pieces),
        "contacts": sum(len(piece.plan.contacts.cells) for piece in supports.pieces),
        "hanging_deeper": sum(len(piece.need.left) for piece in supports.pieces),
        "clinging": len(supports.clinging),
        "stuck": len(supports.walk.stuck),
        "bear": all(piece.plan.bears for piece in supports.pieces),
        "collisions": supports.contacts.collisions,
    }


def _pairs(lots: Sequence[Lot]) -> dict[str, Any]:
    """Return how many bricks lots have, and their pairs of part and colour."""
    pairs = [{"part": lot.part.number, "colour": lot.colour.code, "count": lot.count} for lot in lots]
    return {"bricks": sum(lot.count for lot in lots), "pairs": pairs}


def _size(wanted: ShoppingList) -> dict[str, list[float]]:
    """Return the size of the finished model along x, y and z: in studs and plates, and in cm without the top studs."""
    return {"studs_plates": [*wanted.studs, wanted.plates], "cm": [round(length, 2) for length in wanted.cm]}
