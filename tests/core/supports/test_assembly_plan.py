"""Models with their supports: all stands at every step, all comes out, the model is left."""

from __future__ import annotations

from dataclasses import replace
from typing import get_args

import numpy as np
import pytest

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.supports.assembly_plan import Wish, plan_assembly
from legorize_addon.core.supports.boxes import OUTSIDE_COLOUR
from tests.core.overhanging import overhanging
from tests.core.standing import CATALOGUE, table

SIZES = {"table": 24, "t_shape": 32, "arch": 32, "box_car": 24}
WAYS = [word for word in get_args(Wish) if word != "none"]


@pytest.fixture(scope="module")
def models():
    """Return the four meshes with overhangs as bricks without supports."""
    meshes = overhanging(100.0)
    return {
        name: legorize(meshes[name], Settings(width=width, supports="none")).bricks for name, width in SIZES.items()
    }


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", ["table", "t_shape", "arch", "box_car"])
def test_model_can_be_built(models, name, way):
    """No brick in the air, none squeezed in, every support out again, one component that touches the ground left."""
    found = plan_assembly(Assembly(models[name], CATALOGUE), wish=way, deepest=0)
    assert found.walk.buildable
    assert found.contacts.collisions == 0
    left = found.final.graph
    assert left.n_components == 1
    assert left.n_floating == 0
    assert np.array_equal(found.temporary, found.bricks.role == Role.SUPPORT_OUTSIDE)
    assert (found.removed.colour == OUTSIDE_COLOUR).all()
    assert all(piece.plan.bears for piece in found.pieces)


@pytest.mark.parametrize("name", ["table", "arch"])
def test_nothing_falls_over_on_the_way(models, name):
    """With supports no tower has to be held; without any, something hangs or falls."""
    assert found_faults(plan_assembly(Assembly(models[name], CATALOGUE), deepest=3)) == 0
    assert found_faults(plan_assembly(Assembly(models[name], CATALOGUE), deepest=3, wish="none")) > 0


def found_faults(found):
    """Count what is wrong on the way: deep hanging, towers held by hand, steps that cannot be done."""
    deep = sum(len(piece.need.left) + len(piece.need.contacts) * (piece.plan.way == "none") for piece in found.pieces)
    return deep + len(found.unsteady) + len(found.walk.bad_steps)


def test_model_comes_first_and_unchanged(models):
    """The rows of the model are those that came in, in their order, but for the steps."""
    bricks = models["table"]
    found = plan_assembly(Assembly(bricks, CATALOGUE), deepest=3)
    kept = found.bricks.take(np.arange(len(bricks)))
    for name in ("part", "corner", "turn", "colour", "role", "piece"):
        assert np.array_equal(getattr(kept, name), getattr(bricks, name)), name


def test_different_structures_on_one_model(models):
    """Columns, trees and beams are three different structures, and the best is the lightest of them."""
    mass = {
        way: float(
            CATALOGUE.mass[
                plan_assembly(Assembly(models["t_shape"], CATALOGUE), wish=way, deepest=0).removed.part
            ].sum()
        )
        for way in WAYS
    }
    assert mass["best"] == min(mass.values())
    assert len({mass[way] for way in WAYS[1:]}) == len(WAYS) - 1


def test_nothing_is_added_if_nothing_is_wanted(models):
    """Without supports the model is left as it is, and the check says what cannot be built."""
    found = plan_assembly(
        Assembly(table(("3003", 0, 0, 0), ("3003", 5, 5, 3), ("3003", 0, 0, 3)), CATALOGUE), wish="none", deepest=3
    )
    assert not found.temporary.any()
    assert found.walk.in_air.tolist() == [1]


def test_pieces_get_supports_of_their_own():
    """A wide slab as an upper piece lies on the table: what needed supports under it needs none."""
    slab = (
        [("3001", 0, y, 9) for y in (0, 2, 4, 6)]
        + [("3001", 0, y, 12, 1) for y in (0, 4)]
        + [("3001", 2, y, 12, 1) for y in (0, 4)]
    )
    bricks = table(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3003", 0, 0, 6), *slab)
    whole = plan_assembly(Assembly(bricks, CATALOGUE), deepest=0)
    split = plan_assembly(
        Assembly(replace(bricks, piece=(bricks.corner[:, 2] >= 9).astype(np.int16)), CATALOGUE), deepest=0
    )
    assert len(whole.removed) > 0
    assert len(split.removed) == 0
    assert split.walk.buildable


def test_clinging_bricks_are_named():
    """A brick that one stud holds above and one below may come off with its support."""
    rows = [("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3003", 0, 0, 6), ("3005", 5, 0, 6), ("3009", 0, 0, 9)]
    found = plan_assembly(Assembly(table(*rows), CATALOGUE), deepest=0)
    assert found.clinging.tolist() == [3]
    wide = plan_assembly(Assembly(table(*rows[:3], ("3622", 3, 0, 6), rows[4]), CATALOGUE), deepest=0)
    assert wide.clinging.tolist() == []


def test_wide_chassis_is_interlocked():
    """The layers of a chassis that spans wide are laid in parts of eight studs, and its supports come out again."""
    bricks = legorize(overhanging(100.0)["box_car"], Settings(width=32, supports="none")).bricks
    length = np.array([part.length for part in CATALOGUE.parts])[bricks.part]
    studs = length * np.array([part.width for part in CATALOGUE.parts])[bricks.part]
    layer = np.unique(bricks.corner[:, 2], return_inverse=True)[1]
    area, long = np.bincount(layer, studs), np.bincount(layer, studs * (length == 8))
    chassis = np.flatnonzero(area > 0.8 * area.max())[:2]
    assert (long[chassis] >= 0.8 * area[chassis]).all()
    found = plan_assembly(Assembly(bricks, CATALOGUE), deepest=0)
    assert len(found.walk.stuck) == 0
    assert found.walk.buildable
