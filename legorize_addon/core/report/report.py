"""What was built, in plain numbers and words, for ``report.json``."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any, Final

import numpy as np

from ..build import Build, Finished, Judged, Mosaic
from ..building import Kind
from ..errors import enough_memory
from ..measures import lower_bound
from ..model import Assembly, Catalogue, ContactGraph, Role
from ..progress import Progress, silent
from ..shopping import Lot, ShoppingList, not_made, shopping_list
from ..supports import AssemblyPlan
from ..units import PLATES_PER_BRICK
from .edit_remarks import edit_facts
from .mesh_facts import facts_of_mesh
from .money import price_facts
from .mosaic_facts import facts_of_mosaic
from .ownership import lot_facts, owned_facts
from .remarks import remarks

SCHEMA: Final = 2
"""Version of the keys; raised when one of them changes its meaning."""


@enough_memory()
def report(
    build: Finished,
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
    build : Finished
        A model; one of a mesh, a ``Build``, has all keys, one that was read as
        bricks those about bricks, and a ``Mosaic`` some of its own.
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
    supports = build.supports
    return {
        "schema": SCHEMA,
        "version": version,
        "seed": build.settings.seed,
        "settings": asdict(build.settings),
        "grid": _grid(wanted),
        **(facts_of_mesh(build, mm_per_unit) if isinstance(build, Build) else {}),
        **(facts_of_mosaic(build, catalogue) if isinstance(build, Mosaic) else {}),
        "counts": _counts(build, catalogue, wanted.lots),
        "mass_g": round(wanted.mass, 2),
        "size": _size(wanted),
        "building_time_s": round(wanted.seconds),
        "layout": _layout(build, catalogue, progress if with_bound else None),
        **({"edits": edit_facts(build.outcomes, catalogue)} if isinstance(build, Build) else {}),
        "owned": owned_facts(build, catalogue),
        "few_lots": lot_facts(build, catalogue),
        "price": price_facts(build, catalogue, progress if with_bound else None),
        "connection": _connection(build.graph),
        "stability": _stability(build, catalogue),
        "buildable_steps": supports.walk.n_steps - len(supports.walk.bad_steps),
        "building": _building(build),
        "supports": _supports(supports, catalogue),
        "unavailable_part_colours": _pairs(not_made(wanted.lots)),
        **({"left_out_parts": dict(build.left_out)} if isinstance(build, Judged) else {}),
        "unknown_elements": _pairs([lot for lot in wanted.lots if not lot.element]),
        "timings_s": {stage: round(seconds, 4) for stage, seconds in build.timings.items()},
        "notes": list(build.notes),
    }


def _counts(build: Finished, catalogue: Catalogue, lots: Sequence[Lot]) -> dict[str, Any]:
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
        **({"unit_bricks_before": int(build.grid.solid.any(axis=1).sum())} if isinstance(build, Build) else {}),
        "by_part": dict(by_part),
        "by_colour": dict(sorted(by_colour.items(), key=lambda entry: int(entry[0]))),
    }


def _connection(graph: ContactGraph) -> dict[str, int]:
    return {
        "components": graph.n_components,
        "floating": graph.n_floating,
        "collisions": graph.collisions,
    }


def _layout(build: Finished, catalogue: Catalogue, proving: Progress | None) -> dict[str, Any]:
    """Return how near the number of bricks is to the proven bound, unless nobody waits for the proof.

    The bound holds for every layout of the same cells and colours, with the same
    columns laid in bricks and in plates.
    """
    fewest = None
    if proving is not None and isinstance(build, Build):
        fewest = lower_bound(build.hollow, catalogue, progress=proving)
    return {
        "tier": build.settings.layout,
        "fewest_possible": fewest,
        "at_most_more_percent": None if fewest is None else round(100 * (len(build.bricks) / max(fewest, 1) - 1), 2),
    }


def _stability(build: Finished, catalogue: Catalogue) -> dict[str, Any]:
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


def _building(build: Finished) -> dict[str, Any]:
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
        "leaning_sub_assemblies": len(supports.leaning),
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
            "wedged": (build.proof.wedged + 1).tolist(),
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


def _grid(wanted: ShoppingList) -> dict[str, int]:
    """Return the extent of the finished model in studs and layers."""
    x, y = wanted.studs
    return {"x": x, "y": y, "layers": -(-wanted.plates // PLATES_PER_BRICK)}


def _size(wanted: ShoppingList) -> dict[str, list[float]]:
    """Return the size of the finished model along x, y and z: in studs and plates, and in cm without the top studs."""
    return {"studs_plates": [*wanted.studs, wanted.plates], "cm": [round(length, 2) for length in wanted.cm]}
