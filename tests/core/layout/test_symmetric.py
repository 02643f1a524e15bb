"""One half of a grid is laid, and the other one like it."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.building.mirror import boxes
from legorize_addon.core.layout.lay import FILLER, Manner, cover, sheets_and_shapes
from legorize_addon.core.layout.symmetric import Fold, fold_of, mirrored
from legorize_addon.core.model.bricks import NOBODY, Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill, UnitGrid
from legorize_addon.core.progress import silent

CATALOGUE = load_catalogue()


def grid_of(colour):
    """Return a grid of cells of given colours, (n_layers, 3, n_y, n_x), all of which must be built."""
    colour = np.asarray(colour, dtype=np.int16)
    cover_ = np.where(colour == COLOUR_EMPTY, Fill.EMPTY, Fill.REQUIRED).astype(np.uint8)
    return UnitGrid(colour, cover_, np.zeros(colour.shape, np.uint8), np.zeros(3))


def symmetric_grid(seed, axis, length):
    """Return a random grid of two colours that equals its image along an axis of (3, 3, n_y, n_x)."""
    rng = np.random.default_rng(seed)
    shape = [3, 3, 6, 6]
    shape[axis] = -(-length // 2)
    half = rng.choice(np.array([4, 15, COLOUR_EMPTY], np.int16), shape, p=(0.5, 0.4, 0.1))
    if seed % 2:
        half[:] = half[:, :1]
    whole = np.concatenate([np.flip(half, axis), half], axis=axis)
    return grid_of(np.delete(whole, shape[axis], axis=axis) if length % 2 else whole)


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("axis", [2, 3])
@pytest.mark.parametrize("length", [8, 9])
def test_every_brick_has_its_image(seed, axis, length):
    """The bricks of both halves cover all cells once, in their colours, and each lies where another one is mirrored."""
    grid = symmetric_grid(seed, axis, length)
    fold = Fold(3 - axis, length, CATALOGUE)
    half = fold.half(grid, grid.solid)
    manner = Manner("standard", fold=fold)
    laid = cover(half, sheets_and_shapes(half, CATALOGUE, FILLER), np.random.default_rng(0), manner, silent)
    bricks = fold.unfold(laid)
    graph = contact_graph(bricks, CATALOGUE)
    assert graph.collisions == 0
    owner = np.full(grid.colour.shape, NOBODY).reshape(-1, *grid.colour.shape[2:])
    low = graph.low
    at = tuple(slice(start, start + size) for start, size in zip(low[::-1], graph.owner.shape, strict=True))
    owner[at] = graph.owner
    owner = owner.reshape(grid.colour.shape)
    np.testing.assert_array_equal(owner != NOBODY, grid.solid)
    np.testing.assert_array_equal(bricks.colour[owner][grid.solid], grid.colour[grid.solid])
    assert CATALOGUE.exists_in(bricks.part, bricks.colour).all()
    # what lies across the plane is a plate, not a tile of its size
    assert CATALOGUE.used_for("model")[bricks.part].all()
    # two cells are of one brick exactly where their images are
    image = np.flip(owner, axis)
    pairs = np.unique(np.stack([owner[grid.solid], image[grid.solid]]), axis=1)
    assert len(pairs.T) == len(bricks)
    np.testing.assert_array_equal(np.sort(pairs[1]), np.arange(len(bricks)))
    np.testing.assert_array_equal(bricks.part[pairs[0]], bricks.part[pairs[1]])
    assert len(boxes(bricks, CATALOGUE)) == len(bricks)


def test_bricks_across_the_plane_are_one():
    """A beam of eight studs and one of three have one brick each, and a wide floor no seam along the plane."""
    for length in (8, 3):
        grid = grid_of(np.full((1, 3, 1, length), 4))
        fold = fold_of(grid, CATALOGUE)
        half = fold.half(grid, grid.solid)
        work = sheets_and_shapes(half, CATALOGUE, FILLER)
        bricks = fold.unfold(cover(half, work, np.random.default_rng(0), Manner("standard", fold=fold), silent))
        assert len(bricks) == 1
        assert bricks.corner.tolist() == [[0, 0, 0]]


def test_hidden_cells_become_symmetric_and_others_stay():
    """What must be built inside is built on both sides; a cell in the open that has no image is not equal to it."""
    colour = np.full((3, 3, 5, 6), 4)
    colour[1, :, 1:4, 1:5] = COLOUR_EMPTY
    colour[1, :, 1:4, 1] = COLOUR_ANY
    colour[2, :, :, 0] = COLOUR_EMPTY
    grid = grid_of(colour)
    found, same = mirrored(grid, Fold(0, 6, CATALOGUE))
    assert (found.cover[1, :, 1:4, 4] == Fill.REQUIRED).all()
    assert (found.cover[1, :, 1:4, 2:4] == Fill.EMPTY).all()
    assert (found.cover[2, :, :, 0] == Fill.EMPTY).all()
    assert not same[2, :, :, 5].any()
    assert same[1, :, 1:4, [1, 4]].all()


def test_no_fold_where_nothing_is_mirrored():
    """A stair has none along its steps, but one across them."""
    colour = np.full((4, 3, 5, 8), COLOUR_EMPTY)
    for step in range(4):
        colour[step, :, :, 2 * step :] = 4
    assert fold_of(grid_of(colour), CATALOGUE).axis == 1
    colour[:, :, 0, 3:] = COLOUR_EMPTY
    assert fold_of(grid_of(colour), CATALOGUE) is None


def test_plates_and_bricks_are_never_images():
    """Cells that have to be plates on one side alone are not equal."""
    grid = grid_of(np.full((1, 3, 2, 4), 4))
    grid.role[0, :, :, 0] = Role.PLATE
    _, same = mirrored(grid, Fold(0, 4, CATALOGUE))
    assert same[0, 0].tolist() == [[False, True, True, False]] * 2
