"""Bricks cut into plates: nothing is lost, and what held before holds still."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.layout.joining.cutting import Bench, Laid, Seam
from legorize_addon.core.layout.lay import lay, lay_unjoined
from legorize_addon.core.layout.problem.problem import owners
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY
from tests.core.layout.cells import CATALOGUE, RED, WHITE, grid_of

GLOW_IN_DARK = 21


def bench_of(cells) -> Bench:
    """Lay a grid and put it on the bench."""
    bricks = lay_unjoined(grid_of(cells), CATALOGUE, rng=np.random.default_rng(0))
    n_layers, n_plates, *across = np.shape(cells)
    return Bench(bricks, owners(contact_graph(bricks, CATALOGUE), (n_layers * n_plates + 2, *across)), CATALOGUE)


def block(length=4) -> Bench:
    """Lay one red brick two studs wide."""
    return bench_of(np.full((1, 3, 2, length), RED))


def plate(bench, squares, level, colour=RED) -> Laid:
    """Return the plate that covers squares and no others."""
    [(form, corner), *_] = [
        found for found in bench.forms.within(squares, min(squares), 1, colour) if len(found[0].squares) == len(squares)
    ]
    return Laid(form, corner, level, colour, 0)


def test_what_is_put_on_comes_off():
    """A layout goes through the bench unchanged."""
    bricks = lay(grid_of(np.full((3, 3, 5, 7), RED)), CATALOGUE, rng=np.random.default_rng(0))
    found = Bench(bricks, owners(contact_graph(bricks, CATALOGUE), (11, 5, 7)), CATALOGUE).bricks()
    for name in ("part", "corner", "turn", "colour", "role", "piece", "step"):
        np.testing.assert_array_equal(getattr(found, name), getattr(bricks, name))


@pytest.mark.parametrize("level", [0, 1, 2])
def test_cut_brick_keeps_its_cells(level):
    """Around a plate of one cell the brick becomes plates that cover all the rest once and hold together."""
    bench = block()
    tie = plate(bench, {(0, 0)}, level)
    pieces = bench.cut([0], tie)
    cells = sorted((piece.level, square) for piece in [tie, *pieces] for square in piece.squares)
    assert cells == sorted((z, (x, y)) for z in range(3) for x in range(4) for y in range(2))
    assert bench.holds([tie, *pieces])
    bench.put([0], [tie, *pieces])
    links = contact_graph(bench.bricks(), CATALOGUE)
    assert links.n_components == 1
    assert links.collisions == 0


def test_plate_that_loses_a_cell_does_not_hold():
    """A plate by itself cannot give a cell away: what is left holds to nothing."""
    cells = np.full((1, 3, 1, 4), RED)
    cells[:, 1:] = -2
    bench = bench_of(cells)
    tie = plate(bench, {(0, 0)}, 0)
    assert not bench.holds([tie, *bench.cut([0], tie)])
    whole = plate(bench, {(x, 0) for x in range(4)}, 0)
    assert bench.cut([0], whole) == []
    assert bench.holds([whole])


def test_added_plate_has_to_reach_both_sides():
    """A plate that is added under one brick alone joins nothing; under two of them it does."""
    cells = np.full((2, 3, 1, 4), COLOUR_EMPTY)
    cells[1, :, 0, :2] = RED
    cells[0, 0, 0, 3] = RED
    bench = bench_of(cells)
    tie = plate(bench, {(1, 0), (2, 0)}, 2)
    assert bench.holds([tie])
    assert not bench.reaches(tie, Seam(2, ((1, 0), (2, 0))))
    assert bench.reaches(plate(bench, {(0, 0), (1, 0)}, 2), Seam(2, ((0, 0), (1, 0))))


def test_brick_cannot_be_laid_in_a_plate():
    """A tie higher than what it lies in finds no room."""
    cells = np.full((1, 3, 1, 4), RED)
    cells[:, 1:] = -2
    bench = bench_of(cells)
    [(form, corner), *_] = bench.forms.within({(0, 0)}, (0, 0), 3, RED)
    assert bench.cut([0], Laid(form, corner, 0, RED, 0)) is None


def test_colours_have_their_parts():
    """Only forms that are made in a colour are offered, larger ones first, and squares are tiled by them."""
    bench = block()
    sizes = [len(form.squares) for form in bench.forms.made(1, WHITE)]
    assert sizes == sorted(sizes, reverse=True)
    rows = np.array([form.part for form in bench.forms.made(1, GLOW_IN_DARK)], dtype=np.int64)
    assert CATALOGUE.exists_in(rows, np.int16(GLOW_IN_DARK)).all()
    assert len(rows) < len(sizes)


def test_open_faces():
    """A corner of a block has three open faces, an edge two; on a block of one cell all six are open."""
    bench = bench_of(np.full((1, 3, 3, 4), RED))
    assert bench.open_faces(0, (0, 0)) == 3
    assert bench.open_faces(1, (0, 0)) == 2
    assert bench.open_faces(1, (1, 1)) == 0
    assert bench.open_faces(2, (1, 1)) == 1
    alone = np.full((1, 3, 1, 1), RED)
    alone[:, 1:] = -2
    assert bench_of(alone).open_faces(0, (0, 0)) == 6


def test_what_lies_around_a_seam():
    """Bricks right below and above the ends of a seam are found, each once."""
    cells = np.full((3, 3, 1, 2), RED)
    cells[1] = -2
    bench = bench_of(cells)
    assert bench.over_and_under(Seam(3, ((0, 0), (1, 0)))) == [0]
    assert bench.over_and_under(Seam(5, ((0, 0), (1, 0)))) == [1]
    assert bench.over_and_under(Seam(4, ((0, 0), (1, 0)))) == []
