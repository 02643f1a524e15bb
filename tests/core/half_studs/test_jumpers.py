"""Jumpers: every stud of a block that something lies over by half is covered, and jumpers hold what lies above."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.half_studs.halves import Halves
from legorize_addon.core.half_studs.jumpers import lay_jumpers
from legorize_addon.core.model.bricks import Role, concatenate
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.contacts import collisions_between_grids, contact_graph, stud_columns
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, Fill, UnitGrid

CATALOGUE = load_catalogue()
RED = 4


def halves(*layers, shape):
    """Return half studs that are the same all over each layer."""
    half = np.array([x + 2 * y for x, y in layers], np.uint8)
    return Halves(np.broadcast_to(half[:, None, None], (len(half), *shape)).copy(), 0, np.zeros(3), 0, ())


def block(n_x, n_y):
    """Return a block of a layer, two squares larger on each side than what stands on it, drawn together."""
    cover = np.zeros((2, 3, n_y + 4, n_x + 4), np.uint8)
    cover[0, :, 1:-1, 1:-1] = cover[1, :, 2:-2, 2:-2] = Fill.REQUIRED
    colour = np.where(cover > 0, RED, COLOUR_EMPTY).astype(np.int16)
    return UnitGrid(colour, cover, np.full(cover.shape, Role.SHELL, np.uint8), np.zeros(3))


def plates_above(n_x, n_y, like):
    """Return plates of one stud all over what stands on the plane."""
    y, x = (each.ravel() + 2 for each in np.mgrid[:n_y, :n_x])
    n = len(x)
    made = like.take(np.zeros(n, int))
    corner = np.column_stack([x, y, np.full(n, 3)]).astype(np.int32)
    part = np.full(n, CATALOGUE.part_row("3024"), np.int16)
    return replace(made, part=part, corner=corner, turn=np.zeros(n, np.uint8))


@pytest.mark.parametrize("half", [(1, 0), (0, 1), (1, 1)])
@pytest.mark.parametrize(("n_x", "n_y"), [(1, 1), (2, 2), (3, 2), (3, 3), (4, 5)])
def test_no_stud_is_left_under_what_lies_off_it(half, n_x, n_y):
    """Set apart, nothing collides; studs hold a part of what lies above, at the squares that were said."""
    cells = block(n_x, n_y)
    jumpers, grid = lay_jumpers(cells, halves((0, 0), half, shape=cells.cover.shape[2:]), CATALOGUE, filler=RED)
    assert (jumpers.corner[:, 2] == 2).all()
    covered = {tuple(each) for each in stud_columns(jumpers, CATALOGUE)[1][:, :2].tolist()}
    x, y = (range(2, 2 + n + by) for n, by in zip((n_x, n_y), half, strict=True))
    assert covered == {(i, j) for i in x for j in y}
    above = plates_above(n_x, n_y, jumpers)
    together = concatenate([jumpers, above])
    moved = np.zeros((len(together), 2), np.uint8)
    moved[len(jumpers) :] = half
    apart = replace(together, half=moved)
    links, before = contact_graph(apart, CATALOGUE), contact_graph(together, CATALOGUE)
    assert links.collisions == collisions_between_grids(together, CATALOGUE) == 0
    assert links.pairs.tolist() == before.pairs.tolist()
    kinds = np.array([part.jumper for part in CATALOGUE.parts])[jumpers.part]
    assert len(links.pairs) == np.count_nonzero(kinds) >= 1
    # without jumpers all these studs would stand in what lies above
    plain = replace(apart, part=np.where(moved.any(axis=1), apart.part, CATALOGUE.part_row("3024")).astype(np.int16))
    assert contact_graph(plain, CATALOGUE).collisions > 0
    assert (grid.cover == block(n_x, n_y).cover).all()


def test_back_again_the_stud_counts_to_the_other_square():
    """Above a second jump all lies where the lowest part does: its jumpers themselves lie half a stud on."""
    grid = block(4, 4)
    cover = np.concatenate([grid.cover, grid.cover[1:]])
    grid = UnitGrid(
        np.concatenate([grid.colour, grid.colour[1:]]), cover, np.concatenate([grid.role, grid.role[1:]]), grid.origin
    )
    jumpers, _ = lay_jumpers(grid, halves((0, 0), (1, 0), (0, 0), shape=grid.cover.shape[2:]), CATALOGUE, filler=RED)
    upper = jumpers.take(jumpers.corner[:, 2] == 5)
    kinds = np.array([part.jumper for part in CATALOGUE.parts])[upper.part]
    assert set(upper.turn[kinds].tolist()) == {2}


def test_jumpers_are_made_in_their_colours():
    """A colour in which no jumper is made gives way to the closest in which they are."""
    grid = block(2, 2)
    code = next(int(code) for code in CATALOGUE.codes if not CATALOGUE.exists_in(CATALOGUE.part_row("15573"), code))
    grid = replace(grid, colour=np.where(grid.colour == RED, np.int16(code), grid.colour))
    jumpers, _ = lay_jumpers(grid, halves((0, 0), (1, 0), shape=grid.cover.shape[2:]), CATALOGUE, filler=RED)
    assert CATALOGUE.exists_in(jumpers.part, jumpers.colour).all()


def test_what_stays_on_its_studs_needs_no_jumper():
    """Two towers on a block, one of them off: jumpers lie under that one alone, and none where nothing is off."""
    cover = np.zeros((2, 3, 6, 14), np.uint8)
    cover[0, :, 1:-1, 1:-1] = cover[1, :, 2:-2, 2:4] = cover[1, :, 2:-2, 8:10] = Fill.REQUIRED
    colour = np.where(cover > 0, RED, COLOUR_EMPTY).astype(np.int16)
    grid = UnitGrid(colour, cover, np.full(cover.shape, Role.SHELL, np.uint8), np.zeros(3))
    half = np.zeros((2, 6, 14), np.uint8)
    assert len(lay_jumpers(grid, Halves(half, 0, np.zeros(3), 0, ()), CATALOGUE, filler=RED)[0]) == 0
    half[1, :, 6:] = 1
    jumpers, _ = lay_jumpers(grid, Halves(half, 0, np.zeros(3), 0, ()), CATALOGUE, filler=RED)
    covered = {tuple(each) for each in stud_columns(jumpers, CATALOGUE)[1][:, :2].tolist()}
    assert covered == {(x, y) for x in (8, 9, 10) for y in (2, 3)}
