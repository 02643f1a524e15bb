"""Bricks cut into plates: nothing is lost, and what held before holds still."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.joining.cutting import Bench, Laid, Seam
from legorize_addon.core.layout.lay import lay, lay_unjoined
from legorize_addon.core.layout.problem.problem import owners
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY
from tests.core.any_bricks import table
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


def test_forms_differ():
    """No two forms of a height cover the same squares: what is turned and the same again is left out."""
    for height in (1, 3):
        squares = [frozenset(form.squares) for form in block().forms.made(height, RED)]
        assert len(set(squares)) == len(squares)
        assert {frozenset((y, x) for x, y in each) for each in squares} >= {each for each in squares if len(each) != 3}


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=40, deadline=None)
def test_what_lies_where_is_found_cell_by_cell(seed):
    """Open faces, what a tie reaches, where forms fit, and what holds after a cut, at a place in a random layout."""
    rng = np.random.default_rng(seed)
    cells = rng.choice([COLOUR_EMPTY, RED, RED], (2, 3, 3, 4))
    cells[0, 0, 0, 0] = RED
    bench = bench_of(cells)
    there = np.pad(cells.reshape(6, 3, 4) != COLOUR_EMPTY, 1)
    z, y, x = (int(rng.integers(most)) for most in (6, 3, 4))
    around = [there[z + 1 + i, y + 1 + j, x + 1 + k] for i, j, k in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    around += [there[z + 1 - i, y + 1 - j, x + 1 - k] for i, j, k in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    if there[z + 1, y + 1, x + 1]:
        assert bench.open_faces(z, (x, y)) == 6 - sum(around)
    squares = {(int(a), int(b)) for a, b in rng.integers(0, 4, (9, 2))}
    through = min(squares)
    expected = {
        (form, (through[0] - a, through[1] - b))
        for form in bench.forms.made(1, RED)
        for a, b in form.squares
        if {(through[0] - a + i, through[1] - b + j) for i, j in form.squares} <= squares
    }
    found = list(bench.forms.within(squares, through, 1, RED))
    assert set(found) == expected
    sizes = [len(form.squares) for form, _ in found]
    assert sizes == sorted(sizes, reverse=True)
    seam = Seam(z, ((x, y), (x - 1, y) if x else (x, (y + 1) % 3)))
    tie = plate(bench, {(x, y)}, z)
    at = {end: {level: bool(there[level + 1, end[1] + 1, end[0] + 1]) for level in range(-1, 7)} for end in seam.ends}
    assert bench.reaches(tie, seam) == all(near[z] or near[z - 1] or near[z + 1] for near in at.values())
    numbers = [bench.at(z, (x, y))] if bench.at(z, (x, y)) != NOBODY else []
    pieces = bench.cut(numbers, tie)
    if pieces is not None:
        assert bench.holds([tie, *pieces]) == held([tie, *pieces], bench)


def held(pieces, bench):
    """Tell whether pieces and all bricks that they touch are one, through the pieces alone."""
    of_cell = {(piece.level, *square): k for k, piece in enumerate(pieces) for square in piece.squares}
    links = {(k, k) for k in range(len(pieces))}
    for (level, x, y), k in of_cell.items():
        for step in (-1, 1):
            other = of_cell.get((level + step, x, y))
            number = bench.at(level + step, (x, y))
            if other is not None:
                links.add((k, other))
            elif number != NOBODY:
                links.add((k, len(pieces) + number))
    nodes, joined = {node for link in links for node in link}, {0}
    while more := {node for link in links if set(link) & joined for node in link} - joined:
        joined |= more
    return joined == nodes


def slope_on_plates() -> Bench:
    """Lay a slope of two studs on two plates side by side, and a plate on its studs."""
    row = CATALOGUE.part_row
    bricks = table(
        [
            (row("3022"), 0, 0, 0, 0, RED, 0, 0, 0),
            (row("3022"), 2, 0, 0, 0, RED, 0, 0, 0),
            (row("3039"), 0, 0, 1, 0, RED, 0, 0, 0),
            (row("3023"), 0, 0, 4, 1, RED, 0, 0, 1),
        ]
    )
    return Bench(bricks, owners(contact_graph(bricks, CATALOGUE), (8, 2, 4)), CATALOGUE)


def test_slopes_are_not_cut():
    """Nothing makes room in a slope, not even where it would be tiled by plates."""
    bench = slope_on_plates()
    assert bench.fixed == {2}
    assert bench.cut([2], plate(bench, {(0, 0)}, 1)) is None
    assert bench.cut([0], plate(bench, {(0, 0)}, 0)) is not None


def test_a_slope_holds_by_its_studs_and_sockets():
    """Over its fall there is no stud; under it there are sockets."""
    bench = slope_on_plates()
    assert bench.holding(4, (0, 0), -1) == 2
    assert bench.holding(4, (1, 0), -1) == NOBODY
    assert bench.holding(0, (1, 1), 1) == 2
    assert bench.holding(0, (2, 1), 1) == NOBODY
    assert bench.at(3, (1, 0)) == 2
    # an end that nothing but a fall touches is reached by nothing
    assert not bench.reaches(plate(bench, {(0, 0), (1, 0)}, 4), Seam(4, ((1, 0), (2, 0))))
