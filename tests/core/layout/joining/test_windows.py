"""Windows laid anew to join what is loose."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.joining import windows
from legorize_addon.core.layout.joining.windows import join_by_windows
from legorize_addon.core.layout.lay import FILLER
from legorize_addon.core.layout.problem.problem import with_margins
from legorize_addon.core.layout.problem.shapes import shapes
from legorize_addon.core.layout.problem.sheets import split
from legorize_addon.core.model.bricks import NOBODY, Bricks
from legorize_addon.core.model.catalogue import footprint
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill
from legorize_addon.core.progress import silent
from tests.core.layout.cells import CATALOGUE, RED, assert_covers, brick_grid

BLUE = 1


def single_studs(grid) -> Bricks:
    """Lay every cell of a grid of bricks by itself."""
    layer, y, x = np.nonzero(grid.solid[:, 0])
    n = len(layer)
    colour = grid.colour[layer, 0, y, x]
    return Bricks(
        part=np.full(n, CATALOGUE.part_row("3005"), np.int16),
        corner=np.stack([x, y, 3 * layer], axis=1).astype(np.int32),
        turn=np.zeros(n, np.uint8),
        colour=np.where(colour == COLOUR_ANY, np.int16(FILLER), colour),
        role=np.zeros(n, np.uint8),
        piece=np.zeros(n, np.int16),
        step=layer.astype(np.int32),
    )


def joined(grid, bricks) -> Bricks:
    """Join a model by windows."""
    codes = np.unique(grid.colour[grid.colour >= 0])
    work = [(each, shapes(CATALOGUE, each.height, codes, FILLER)) for each in split(grid)]
    return join_by_windows(bricks, grid, work, CATALOGUE, silent)


def test_two_towers_side_by_side():
    """Towers of single studs that touch become one piece by one brick across both."""
    grid = brick_grid(np.full((3, 1, 2), RED))
    bricks = single_studs(grid)
    assert contact_graph(bricks, CATALOGUE).n_components == 2
    found = joined(grid, bricks)
    assert_covers(found, grid)
    assert contact_graph(found, CATALOGUE).n_components == 1
    assert len(found) == 5


def test_what_colours_keep_apart_stays_apart():
    """A red and a blue tower have no common brick: the model stays as it is."""
    colour = np.full((3, 1, 2), RED)
    colour[..., 1] = BLUE
    grid = brick_grid(colour)
    bricks = single_studs(grid)
    assert joined(grid, bricks) is bricks


def test_free_cells_take_the_colour_that_joins():
    """A tower of any colour between red and blue ones can hold both, in different layers."""
    colour = np.full((3, 1, 3), COLOUR_ANY)
    colour[..., 0], colour[..., 2] = RED, BLUE
    grid = brick_grid(colour)
    found = joined(grid, single_studs(grid))
    assert_covers(found, grid)
    assert contact_graph(found, CATALOGUE).n_components == 1


@settings(max_examples=15)
@given(st.integers(0, 2**32 - 1))
def test_windows_never_make_it_worse(seed):
    """Whatever the model: the same cells are covered, with no more floating bricks and components than before."""
    rng = np.random.default_rng(seed)
    grid = brick_grid(rng.choice([COLOUR_EMPTY, COLOUR_ANY, RED, BLUE], (3, 4, 5), p=[0.3, 0.1, 0.4, 0.2]))
    if not grid.solid.any():
        return
    bricks = single_studs(grid)
    before = contact_graph(bricks, CATALOGUE)
    found = joined(grid, bricks)
    after = contact_graph(found, CATALOGUE)
    assert_covers(found, grid)
    assert (after.n_floating, after.n_components) <= (before.n_floating, before.n_components)
    cells = sum(
        len(footprint(CATALOGUE.parts[part], int(turn))) for part, turn in zip(found.part, found.turn, strict=True)
    )
    assert cells == grid.solid[:, 0].sum()


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_windows_are_judged_as_the_whole_model_is(seed):
    """Whether a window is better, which is told from what lies around it, agrees with the graph of all bricks."""
    rng = np.random.default_rng(seed)
    share = rng.choice([0.3, 0.5])
    grid = brick_grid(rng.choice([COLOUR_EMPTY, COLOUR_ANY, RED, BLUE], (3, 4, 5), p=[share, 0.1, 0.7 - share, 0.2]))
    if not grid.solid.any():
        return
    judged, better, relaid = [], windows._better, windows._relaid

    def tell(model, *rest):
        judged.append((model, better(model, *rest)))
        return True

    def compared(model, *rest):
        del judged[:]
        bricks = relaid(model, *rest)
        if judged:
            after, before = contact_graph(bricks, CATALOGUE), model.links
            gain = (after.n_floating, after.n_components) < (before.n_floating, before.n_components)
            assert judged[0][1] == gain

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(windows, "_TRIES", (4, 10**6))
        patched.setattr(windows, "_better", tell)
        patched.setattr(windows, "_relaid", compared)
        joined(grid, single_studs(grid))


def test_a_plate_is_in_one_sheet():
    """Of sheets of bricks with a gap between them, that whose three plates hold a level, or none."""
    colour = np.full((4, 1, 1), RED)
    colour[2] = COLOUR_EMPTY
    (sheets,) = split(brick_grid(colour))
    found = [windows._sheet_at(sheets, level) for level in range(-1, 13)]
    assert [None if each is None else each.level.tolist() for each in found] == [
        None, *[[0]] * 3, *[[3]] * 3, *[None] * 3, *[[9]] * 3, None,
    ]  # fmt: skip


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_a_window_has_the_bricks_taken_out_and_free_cells_of_its_box(seed):
    """Cell by cell: those of the bricks, wherever they lie, and in the box what is free and need not be covered."""
    rng = np.random.default_rng(seed)
    colour = rng.choice([COLOUR_EMPTY, COLOUR_ANY, RED], (1, 4, 5))
    colour[0, 0, 0] = RED
    cover = np.where(colour == COLOUR_EMPTY, Fill.EMPTY, rng.choice([Fill.OPTIONAL, Fill.REQUIRED], colour.shape))
    cover[0, 0, 0] = Fill.REQUIRED
    (sheet,) = split(brick_grid(colour, cover))
    plane = np.where(colour[0] == COLOUR_EMPTY, NOBODY, rng.integers(NOBODY, 4, (4, 5)))
    out, box = np.array([1, 3]), (slice(0, 3), slice(2, 5))
    found = windows._window(sheet, plane, out, box)
    for y in range(4):
        for x in range(5):
            free = y < 3 and x >= 2 and plane[y, x] == NOBODY and cover[0, y, x] != Fill.REQUIRED
            inside = plane[y, x] in out or free
            assert found.colour[0, y, x] == (colour[0, y, x] if inside else COLOUR_EMPTY)
            assert found.required[0, y, x] == (inside and cover[0, y, x] == Fill.REQUIRED)


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_contacts_are_cells_of_loose_components_beside_others(seed):
    """All pairs of cells side by side are looked at: of each component but the largest, the smaller ones first."""
    rng = np.random.default_rng(seed)
    grid = brick_grid(rng.choice([COLOUR_EMPTY, COLOUR_ANY, RED, BLUE], (2, 3, 4), p=[0.3, 0.2, 0.3, 0.2]))
    if not grid.solid.any():
        return
    bricks = single_studs(grid)
    model = windows._Model.of(
        bricks, contact_graph(bricks, CATALOGUE), with_margins(grid.cover == Fill.REQUIRED, False)
    )
    colour, owner = grid.colour.reshape(-1, 3, 4), model.owner[1:-1]
    member = {(z, y, x): int(model.links.component[owner[z, y, x]]) for z, y, x in np.argwhere(owner > NOBODY).tolist()}
    sizes = np.bincount(model.links.component)
    beside: dict[int, set] = {each: set() for each in range(len(sizes))}
    for (z, y, x), own in member.items():
        for other in ((z, y, x + 1), (z, y + 1, x)):
            codes = {int(colour[z, y, x]), int(colour[other])} - {COLOUR_ANY} if other in member else {RED, BLUE}
            if len(codes) < 2 and member[other] != own:
                beside[own].add((z, y, x))
                beside[member[other]].add(other)
    found = list(windows._contacts(model, windows._beside(grid)))
    order = np.argsort(sizes, kind="stable").tolist()
    assert [member[each] for each in found] == [
        each for each in order[:-1] for place in found if member[place] == each
    ]  # fmt: skip
    for each in order[:-1]:
        places = {place for place in found if member[place] == each}
        assert places <= beside[each]
        # a cell beside two others stands twice in the list of which six are tried
        assert min(len(beside[each]), 3) <= len(places) <= 6
