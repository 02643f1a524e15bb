"""The exact repair: known repairs, the cells stay covered, and the overdraft never grows."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.lay import lay
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.owned.repair import repair_parts
from tests.core.any_bricks import CATALOGUE, table
from tests.core.layout.cells import RED, brick_grid, random_sheet
from tests.core.owned_box import owning

NUMBER = {part.number: row for row, part in enumerate(CATALOGUE.parts)}


def over(assembly, owned):
    """Return how many bricks go beyond the owned ones."""
    return int(np.maximum(np.bincount(assembly.bricks.part, minlength=len(owned)) - owned, 0).sum())


def cells(assembly):
    """Return which cells are filled."""
    return assembly.graph.owner >= 0


@pytest.mark.parametrize(
    "lots",
    [{("3003", 4): 2}, {("3010", 0): 2}, {("3005", 4): 8}, {("3020", 4): 3}, {("3004", 1): 4}],
)
def test_one_brick_is_laid_of_what_there_is(lots):
    """A 2 x 4 becomes two 2 x 2, two 1 x 4, eight 1 x 1 or three plates."""
    brick = Assembly(
        table([(NUMBER["3001"], 0, 0, 3, 0, 4, 0, 0, 0), (NUMBER["3007"], -2, 0, 0, 0, 4, 0, 0, 0)]), CATALOGUE
    )
    owned = (owning(lots) + owning({("3007", 4): 1})).sum(axis=1)
    repaired = repair_parts(brick, owned)
    assert over(brick, owned) == 1
    assert over(repaired, owned) == 0
    np.testing.assert_array_equal(cells(repaired), cells(brick))


def test_what_suffices_is_left_as_it_is():
    """The same object comes back."""
    brick = Assembly(table([(NUMBER["3001"], 0, 0, 0, 0, 4, 0, 0, 0)]), CATALOGUE)
    assert repair_parts(brick, owning({("3001", 4): 1}).sum(axis=1)) is brick


@pytest.mark.parametrize("other", ["15573", "3069b", "85984", "43722", "51739"])
def test_what_was_chosen_for_its_place_stays(other):
    """Jumpers, tiles, slopes and wedge plates are not laid anew as plates beside a plate that is missing."""
    height = CATALOGUE.height[NUMBER[other]]
    plain = "3023" if height == 1 else "3004"
    model = Assembly(
        table([(NUMBER[plain], 0, 0, 0, 0, 4, 0, 0, 0), (NUMBER[other], 4, 0, 0, 0, 4, 0, 0, 0)]), CATALOGUE
    )
    repaired = repair_parts(model, owning({("3024", 4): 9, ("3005", 4): 9}).sum(axis=1))
    assert NUMBER[other] in repaired.bricks.part


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=10, deadline=None)
def test_overdraft_never_grows_and_cells_stay(seed):
    """Whatever is owned, no more bricks go beyond it than before, and the same cells are filled."""
    rng = np.random.default_rng(seed)
    sheets = [random_sheet([seed, number]) for number in range(2)]
    grid = brick_grid(*(np.stack(each) for each in zip(*sheets, strict=True)))
    model = Assembly(lay(grid, CATALOGUE, rng=rng), CATALOGUE)
    owned = rng.integers(0, 12, len(CATALOGUE.parts)) * (CATALOGUE.height == 3)
    repaired = repair_parts(model, owned)
    assert over(repaired, owned) <= over(model, owned)
    assert repaired.graph.n_components <= model.graph.n_components
    np.testing.assert_array_equal(cells(repaired), cells(model))
    assert repaired.graph.collisions == 0


def test_negative_places():
    """Bricks below the origin of the grid are laid anew where they are."""
    brick = Assembly(table([(NUMBER["3001"], -9, -7, -6, 0, RED, 0, 0, 0)]), CATALOGUE)
    repaired = repair_parts(brick, owning({("3003", 4): 2}).sum(axis=1))
    assert sorted(map(tuple, repaired.bricks.corner.tolist())) in ([(-9, -7, -6), (-7, -7, -6)],) or (
        repaired is brick and brick.graph.n_components < 2
    )
