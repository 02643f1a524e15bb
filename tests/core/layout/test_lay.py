"""Whole layouts: what must hold of every one, and what is known of special ones."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.errors import BuildError, Cancelled
from legorize_addon.core.layout.joining.ties import add_ties
from legorize_addon.core.layout.lay import Tier, _batches, _Listed, lay, lay_unjoined
from legorize_addon.core.layout.problem.placements import placements
from legorize_addon.core.layout.problem.shapes import shapes
from legorize_addon.core.layout.problem.sheets import split
from legorize_addon.core.model.bricks import Bricks, Role
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill
from legorize_addon.core.shell.hollowing import hollow
from tests.core.layout.cells import CATALOGUE, assert_covers, brick_grid, grid_of, with_part

RED, WHITE, BLUE, SAND_GREEN = 4, 15, 1, 378
TIERS = get_args(Tier)
GOLDEN = Path(__file__).parents[2] / "golden" / "layouts.json"


def laid(grid, seed=0, **options):
    """Return the bricks of a grid."""
    return lay(grid, CATALOGUE, rng=np.random.default_rng(seed), **options)


def rows(bricks):
    """Return a table as a list of tuples."""
    return list(zip(*(getattr(bricks, name).tolist() for name in Bricks.__slots__), strict=True))


def random_grid(seed, plates):
    """Return a small solid at random, of bricks or of single plates, in four colours and any."""
    rng = np.random.default_rng(seed)
    shape = (3, 3 if plates else 1, 7, 8)
    colour = rng.choice([COLOUR_EMPTY, COLOUR_ANY, COLOUR_ANY, RED, WHITE, BLUE, SAND_GREEN], shape)
    cover = np.where(
        colour == COLOUR_EMPTY, Fill.EMPTY, rng.choice([Fill.OPTIONAL, Fill.REQUIRED, Fill.REQUIRED], shape)
    )
    colour[0, :, 0, 0], cover[0, :, 0, 0] = RED, Fill.REQUIRED
    return grid_of(*(np.broadcast_to(each, (3, 3, 7, 8)) for each in (colour, cover)))


@given(st.integers(0, 2**32 - 1), st.booleans(), st.sampled_from(TIERS))
@settings(max_examples=25, deadline=None)
def test_what_every_layout_keeps(seed, plates, tier):
    """Must cells once, optional cells at most once, empty ones never; colours kept; parts exist; nothing overlaps."""
    grid = random_grid(seed, plates)
    bricks = laid(grid, tier=tier)
    assert_covers(bricks, grid)
    assert (bricks.step == bricks.corner[:, 2] // 3).all()
    assert (np.diff(bricks.corner[:, 2]) >= 0).all()
    assert (bricks.piece == 0).all()


@pytest.mark.parametrize("tier", TIERS)
def test_parts_longer_than_those_that_are_shipped_are_laid(tier):
    """A catalogue with bricks of 1 x 16 and plates of 9 x 1 more lays rows of them, and all else as ever."""
    catalogue = with_part(with_part(CATALOGUE, 16, 1), 9, 1, height=1)
    row = brick_grid(np.full((2, 1, 16), RED))
    bricks = lay(row, catalogue, rng=np.random.default_rng(0), tier=tier)
    assert {catalogue.parts[part].length for part in bricks.part} == {16}
    grid = random_grid(1, plates=True)
    assert_covers(lay(grid, catalogue, rng=np.random.default_rng(0), tier=tier), grid, catalogue)


@given(st.integers(0, 2**32 - 1), st.integers(0, 5), st.sampled_from(TIERS))
@settings(max_examples=6, deadline=None)
def test_same_seed_same_model(seed, run, tier):
    """The same grid and state of the generator give the same table."""
    grid = random_grid(seed, plates=True)
    assert rows(laid(grid, run, tier=tier)) == rows(laid(grid, run, tier=tier))


@pytest.mark.parametrize("tier", TIERS)
def test_a_hollow_box_hangs_together(tier):
    """Walls, floor and roof of a hollow box are one component: no brick of the wide roof floats."""
    grid = hollow(brick_grid(np.full((8, 24, 24), COLOUR_ANY)), shell=1)
    links = assert_covers(laid(grid, tier=tier), grid)
    assert links.n_floating == 0
    assert links.n_components == 1


@pytest.mark.parametrize("tier", TIERS)
def test_a_wall_is_bonded(tier):
    """Most joints of a wall lie over the middle of a brick, not over a joint of the layer below."""
    bricks = laid(brick_grid(np.full((10, 1, 60), RED)), tier=tier)
    links = assert_covers(bricks, brick_grid(np.full((10, 1, 60), RED)))
    layers = links.owner[::3, 0]
    seams = layers[:, 1:] != layers[:, :-1]
    assert np.count_nonzero(seams[1:] & seams[:-1]) < 0.1 * np.count_nonzero(seams[1:])
    assert links.n_components == 1


def test_colours_meet_at_their_border():
    """Two halves of a block in two colours need one brick each."""
    colour = np.full((1, 4, 4), RED)
    colour[:, :, 2:] = WHITE
    bricks = laid(brick_grid(colour))
    assert sorted(bricks.colour.tolist()) == [RED, WHITE]
    assert (CATALOGUE.part_row("3001") == bricks.part).all()


def test_hidden_bricks_get_the_filler():
    """Bricks that nobody sees have the filler colour, and the role inside."""
    grid = brick_grid(np.full((1, 2, 4), COLOUR_ANY))
    inside = grid_of(grid.colour, role=np.full(grid.colour.shape, Role.INSIDE))
    bricks = laid(inside, filler=BLUE)
    assert bricks.colour.tolist() == [BLUE]
    assert bricks.role.tolist() == [Role.INSIDE]


def test_a_brick_shows_if_one_of_its_cells_does():
    """The role of a brick is inside only if all of its cells are inside."""
    role = np.full((1, 3, 2, 4), Role.INSIDE)
    role[0, :, 0, 0] = Role.OFFSET
    bricks = laid(grid_of(np.full((1, 3, 2, 4), RED), role=role))
    assert bricks.role.tolist() == [Role.OFFSET]


def test_plates_where_bricks_do_not_fit():
    """A column of two plates over a brick is laid with plates, level by level."""
    colour = np.full((2, 3, 1, 1), RED)
    colour[1, 2] = COLOUR_EMPTY
    bricks = laid(grid_of(colour))
    assert bricks.corner[:, 2].tolist() == [0, 3, 4]
    assert [CATALOGUE.parts[part].height for part in bricks.part] == [3, 1, 1]


def test_a_model_above_the_ground():
    """Empty layers below the model change nothing but the level."""
    colour = np.full((4, 3, 5), COLOUR_EMPTY)
    colour[2:] = RED
    assert laid(brick_grid(colour)).corner[:, 2].min() == 6


def test_nothing_to_build():
    """A grid without required cells is refused."""
    with pytest.raises(BuildError, match="no cells"):
        laid(brick_grid(np.full((2, 3, 3), COLOUR_EMPTY)))


def test_a_colour_without_bricks_of_one_cell():
    """Where no part of one cell exists and no larger one fits, one sentence names the colour."""
    exists = CATALOGUE.exists.copy()
    exists[CATALOGUE.part_row("3005"), CATALOGUE.colour_row(RED)] = False
    catalogue = replace(CATALOGUE, exists=exists)
    with pytest.raises(BuildError, match=f"1 cell .* colour {RED}"):
        lay(brick_grid([[[RED]]]), catalogue, rng=np.random.default_rng(0))
    pair = brick_grid([[[RED, RED]]])
    assert_covers(lay(pair, catalogue, rng=np.random.default_rng(0)), pair, catalogue)


def test_progress_may_cancel():
    """A request to stop comes through."""

    def stop(stage, share):
        assert 0 <= share <= 1
        raise Cancelled

    with pytest.raises(Cancelled):
        laid(brick_grid(np.full((1, 2, 2), RED)), progress=stop)


def test_loose_bricks_are_left_where_joining_is_not_wanted():
    """Without joining, the layout covers the same cells, and is the same where nothing was loose."""
    grid = random_grid(7, plates=True)
    assert_covers(lay_unjoined(grid, CATALOGUE, rng=np.random.default_rng(0)), grid)
    solid = hollow(brick_grid(np.full((4, 8, 8), RED)), shell=1)
    assert rows(lay_unjoined(solid, CATALOGUE, rng=np.random.default_rng(0))) == rows(laid(solid))


def test_progress_grows_slab_by_slab(monkeypatch):
    """What is told of a layout in three slabs grows from 0, in three parts of the same length."""
    monkeypatch.setattr(sys.modules[lay.__module__], "_SLAB", 40)
    told = []
    grid = brick_grid(np.full((6, 4, 5), RED))
    laid(grid, progress=lambda stage, share: told.append(share) if stage == "layout" else None)
    assert told == sorted(told)
    assert told[0] == 0
    assert max(told) < 1
    assert {int(3 * share) for share in told} == {0, 1, 2}


def test_every_other_sheet_is_laid_at_once():
    """Each half has the sheets of even or of odd numbers, in batches below the limit unless one sheet is above it."""
    (sheets,) = split(brick_grid(np.full((6, 3, 3), RED)))
    among = shapes(CATALOGUE, 3, np.array([RED]), 71)
    listed = _Listed(sheets, among, placements(sheets, among), None)
    each = len(listed.found) // 6
    for half in (0, 1):
        for most, n_batches in ((np.inf, 1), (2 * each, 2), (1, 3)):
            batches = list(_batches([listed], half, most))
            assert len(batches) == n_batches
            levels = np.concatenate([batch.sheets.level for batch in batches])
            assert levels.tolist() == [3 * number for number in range(half, 6, 2)]


def layouts():
    """Return the number of bricks and a digest of all of them, by the name of a grid and the tier.

    Solvers for whole numbers find other covers of the same cost in other versions: what they lay is only counted.
    """
    grids = {f"random {seed}": random_grid(seed, plates=seed % 2 == 1) for seed in range(4)}
    grids["wall"] = brick_grid(np.full((6, 1, 30), RED))
    grids["hollow box"] = hollow(brick_grid(np.full((5, 12, 14), COLOUR_ANY)), shell=1)
    made = {(name, tier): rows(laid(grid, tier=tier)) for name, grid in grids.items() for tier in TIERS}
    made["slab", "standard"] = rows(laid(brick_grid(np.full((2, 40, 44), RED)), tier="standard"))
    colour = np.where(np.arange(14) < 6, RED, WHITE) * np.ones((6, 12, 1), int)
    colour[:, 4:8, 5:9] = BLUE
    grid = hollow(brick_grid(colour), shell=1)
    made["tied", "standard"] = rows(add_ties(laid(grid), grid, CATALOGUE, plates=True)[0])
    return {
        f"{name}, {tier}": [len(bricks), "" if tier == "exact" else sha256(repr(bricks).encode()).hexdigest()[:16]]
        for (name, tier), bricks in made.items()
    }


def test_layouts_are_those_of_the_golden_file():
    """Many numbers that were found by trial decide about bricks: whoever moves one sees here what changes.

    After a change that is wanted, compare the numbers of bricks, and write the file anew: it is ``layouts()`` as JSON.
    """
    assert layouts() == json.loads(GOLDEN.read_text(encoding="utf-8"))
