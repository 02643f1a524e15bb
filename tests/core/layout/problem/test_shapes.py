"""The parts in all their orientations, each once, and the colours they are made in."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.layout.problem.shapes import pattern_bits, shapes
from tests.core.layout.cells import CATALOGUE, with_part

FILLER = 71
RED = 4


@pytest.mark.parametrize("height", [1, 3])
def test_there_are_24_shapes(height):
    """The 12 bricks and the 12 plates have 24 orientations each, all different."""
    among = shapes(CATALOGUE, height, np.array([RED]), FILLER)
    assert len(among.part) == 24
    assert len(np.unique(among.pattern)) == 24
    assert among.size.sum() == 147


def test_inner_edges_of_a_rectangle():
    """A w x l shape has (w - 1) l + w (l - 1) edges between its own cells, a corner has two."""
    among = shapes(CATALOGUE, 3, np.array([RED]), FILLER)
    first = np.cumsum(among.size) - among.size
    for row, (part, (w, length)) in enumerate(zip(among.part, among.extent, strict=True)):
        edges = np.count_nonzero(among.inner[:, first[row] : first[row] + among.size[row]])
        assert edges == (2 if CATALOGUE.parts[part].corner else (w - 1) * length + w * (length - 1))


def test_rows_of_finds_part_and_turn():
    """Each shape is found again by its part and turn."""
    among = shapes(CATALOGUE, 1, np.array([RED]), FILLER)
    np.testing.assert_array_equal(among.rows_of(among.part, among.turn), np.arange(24))


@pytest.mark.parametrize("side", [1, 3, 8, 9, 16])
def test_pattern_bits_are_different(side):
    """All cells of the field have different bits, also where they are more than 64."""
    y, x = np.divmod(np.arange(side**2), side)
    bits = pattern_bits(x, y, side)
    assert sorted(bits.tolist()) == [1 << n for n in range(side**2)]


@pytest.mark.parametrize(("length", "width"), [(9, 1), (16, 2), (9, 9)])
def test_parts_may_be_longer_than_those_that_are_shipped(length, width):
    """A longer part in the catalogue becomes a shape whose largest smaller parts cover it."""
    among = shapes(with_part(CATALOGUE, length, width), 3, np.array([RED], np.int16), FILLER)
    assert among.side == length
    assert len(np.unique(among.pattern)) == len(among.size)
    for row in np.flatnonzero(among.size == length * width):
        squares = {(x, y) for part, *corner in among.pieces[row] for x, y in (among.cells[part] + corner).tolist()}
        assert squares == {tuple(square) for square in among.cells[row].tolist()}


def test_hidden_parts_take_the_filler_or_what_there_is():
    """Parts that nobody sees get the filler colour where it is made, and always one that exists."""
    unusual = int(CATALOGUE.codes[~CATALOGUE.exists[:12].all(axis=0)][0])
    for filler in (FILLER, unusual):
        among = shapes(CATALOGUE, 3, np.array([RED]), filler)
        assert CATALOGUE.exists_in(among.part, among.hidden).all()
        made = CATALOGUE.exists_in(among.part, filler)
        assert (among.hidden[made] == filler).all()
    assert not made.all()


def test_parts_within_are_the_largest_parts_inside():
    """Each inner part lies inside its outer one, none inside another inner one; a single stud has none."""
    among = shapes(CATALOGUE, 3, np.array([4], np.int16), 71)
    cells = [set(map(tuple, each.tolist())) for each in among.cells]
    inner = [
        [{(a + x, b + y) for a, b in cells[part]} for part, x, y in among.within[:, :, row] if part >= 0]
        for row in range(len(cells))
    ]
    for outer, parts in zip(cells, inner, strict=True):
        assert (len(parts) == 0) == (len(outer) == 1)
        assert all(part < outer for part in parts)
        assert not any(one < other for one in parts for other in parts)


@pytest.mark.parametrize("height", [1, 3])
def test_pieces_cover_the_shape(height):
    """The smaller shapes that one is merged from cover its squares together, and no other ones."""
    among = shapes(CATALOGUE, height, np.array([4], dtype=np.int16), 71)
    merged = 0
    for cells, pieces in zip(among.cells, among.pieces, strict=True):
        if len(pieces):
            covered = {(x, y) for row, *corner in pieces for x, y in (among.cells[row] + corner).tolist()}
            assert covered == {tuple(square) for square in cells.tolist()}
            merged += 1
    assert merged > len(among.size) / 2
