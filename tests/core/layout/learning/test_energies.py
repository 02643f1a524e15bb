"""The paper's energies: every worked number of the texts, and what must hold in general."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.layout.learning.energies import (
    efficiency,
    gauss_normalised,
    horizontal_stability,
    minimum_unit_connection,
    symmetry,
    vertical_stability,
)
from legorize_addon.core.model.unit_grid import COLOUR_ANY

RED, BLUE = 4, 1


def layer(*rows: str) -> np.ndarray:
    """Draw a layer: each letter is a brick, a dot is nothing."""
    letters = sorted({letter for row in rows for letter in row} - {"."})
    return np.array([[letters.index(letter) if letter != "." else -1 for letter in row] for row in rows])


def of_one_colour(owner) -> np.ndarray:
    """Return red for every brick."""
    return np.full(owner.max() + 1, RED, np.int16)


# ------------------------------------------------------------ minimum unit connection


def test_two_diagonal_pairs_and_what_becomes_of_them():
    """Four single studs in two diagonal pairs score 1; joined to two corner parts they score 0."""
    assert minimum_unit_connection(layer("a...", ".b.c", "..d."), np.full(4, RED, np.int16)) == 1.0
    joined = layer("aa..", ".abb", "..b.")
    assert minimum_unit_connection(joined, of_one_colour(joined)) == 0.0


def test_only_colours_that_agree_count():
    """A red and a blue stud make no pair, one of any colour makes one with either; larger bricks none."""
    pair = layer("a.", ".b")
    assert minimum_unit_connection(pair, np.array([RED, BLUE], np.int16)) == 0.0
    assert minimum_unit_connection(pair, np.array([RED, COLOUR_ANY], np.int16)) == 1.0
    assert minimum_unit_connection(layer("aa.", "..b"), np.array([RED, RED], np.int16)) == 0.0
    assert minimum_unit_connection(layer("..", ".."), np.zeros(0, np.int16)) == 0.0


# ------------------------------------------------------------ stability


def test_horizontal_stability_of_the_worked_example():
    """Ring overlaps of 4 and 1 give (20 + 23) / 24 = 43/24."""
    brick = layer("........", "..aaaa..", "..aaaa..", "........")
    above = layer("..bb....", "..bb....", "..ccc...", "..ccc...")
    # of the upper bricks' cells two and three lie in the ring: of b two, of c three; one of them moved off
    above = layer("..bb....", "..bb....", "...c....", "...cc...")
    below = layer("........", ".dddd...", "........", "........")
    assert horizontal_stability(brick, 1, above, below) == pytest.approx(43 / 24)


def test_vertical_stability_of_the_worked_example():
    """Of a 2 x 8, six studs covered above and three below: 10/16 + 13/16 = 23/16."""
    brick = np.zeros((2, 8), int)
    above, below = np.zeros((2, 2, 8), bool)
    above[:, 1:4] = True
    below[0, 2:5] = True
    assert vertical_stability(brick, 1, above, below) == pytest.approx(23 / 16)


def test_only_bricks_that_overlap_hold():
    """A brick beside, in the other layer, that does not lie on the brick counts nothing."""
    brick = layer("....", ".aa.", "....")
    beside = layer("bbbb", "....", "....")
    none = np.full((3, 4), -1)
    assert horizontal_stability(brick, 1, beside, none) == 2.0
    across = layer(".b..", ".b..", ".b..")
    assert horizontal_stability(brick, 1, across, none) == pytest.approx((24 - 2) / 24 + 1)
    assert horizontal_stability(brick, 1, None, none) == 2.0


def test_ring_of_the_longest_brick_is_full():
    """A 2 x 8 under bricks that all overlap it and fill its ring of 24 cells costs nothing from above."""
    brick = np.full((4, 10), -1)
    brick[1:3, 1:9] = 0
    above = np.zeros((4, 10), int)
    assert horizontal_stability(brick, 1, above, np.full((4, 10), -1)) == pytest.approx(1.0)


# ------------------------------------------------------------ symmetry


@pytest.mark.parametrize(
    ("rows", "expected"),
    [
        (("aabb", "aabb"), 0),
        (("aab", "aab"), 0),
        (("aab", "aac", "ddd"), 3 / 4),
        (("abbc", "abbc", "dddd"), 0),
        (("abb", "ccd"), 1),
    ],
)
def test_symmetry_of_small_layouts(rows, expected):
    """Mirrored bricks are balanced, others are not; the better axis counts."""
    owner = layer(*rows)
    assert symmetry(owner, of_one_colour(owner)) == pytest.approx(expected)


@pytest.mark.parametrize(("odd", "n"), [(6, 9), (5, 9), (13, 29), (0, 8), (0, 11)])
def test_symmetry_counts_the_unbalanced_bricks(odd, n):
    """6 of 9 and 5 of 9, 0 of 8 and 0 of 11 as in the published figures; and 13 of 29."""
    names = iter(map(chr, range(ord("A"), ord("A") + n)))
    # a long and a short brick in a row have no mirror image, nor has a short one alone; two equal ones are each other's
    # and the axis goes through the middle of one that is as long as the row
    shapes = [(5, 3)] * (odd // 2) + [(3,)] * (odd % 2) + [(4, 4)] * ((n - odd) // 2) + [(8,)] * ((n - odd) % 2)
    owner = layer(*("".join(next(names) * length for length in row).ljust(8, ".") for row in shapes))
    assert owner.max() + 1 == n
    # up and down, where no row but the one in the middle is like its mirror image, even more is unbalanced
    assert symmetry(owner, of_one_colour(owner)) == pytest.approx(odd / n)
    assert symmetry(owner.T, of_one_colour(owner)) == pytest.approx(odd / n)


def test_colour_breaks_symmetry():
    """Two mirrored bricks of different colours are not balanced."""
    owner = layer("aab", "aac", "ddb", "ddc")
    assert symmetry(layer("ab"), np.array([RED, BLUE], np.int16)) == pytest.approx(0.0)
    assert symmetry(layer("ab", "ab"), np.array([RED, RED], np.int16)) == 0.0
    tall = layer("ab", "a.")
    assert symmetry(tall, np.array([RED, BLUE], np.int16)) > 0
    assert 0 <= symmetry(owner, of_one_colour(owner)) <= 1


# ------------------------------------------------------------ efficiency


def test_efficiency_of_the_worked_examples():
    """Single studs 1; one 2 x 4 8/15; 13 bricks of 56 studs .7795 and, with a corner joined, 12 of 58 .7444."""
    single = np.ones(4, int)
    assert efficiency(single, np.zeros(4, bool)) == 1.0
    for size, expected in ((8, 8), (4, 12), (2, 14), (1, 15), (16, 0)):
        assert efficiency(np.array([size]), np.zeros(1, bool)) == pytest.approx(expected / 15)
    sizes = np.array([1, 1, 8, 8, 6, 6, 6, 4, 4, 4, 3, 3, 2])
    assert (len(sizes), sizes.sum()) == (13, 56)
    assert efficiency(sizes, np.zeros(13, bool)) == pytest.approx(0.7795, abs=5e-5)
    # the two single studs become a corner part of three studs, which counts as 1 x 2 x 2
    joined = np.array([3, *sizes[2:]])
    assert efficiency(joined, np.arange(12) == 0) == pytest.approx(0.7444, abs=5e-5)


# ------------------------------------------------------------ normalisation


def test_gauss_normalisation():
    """The mean goes to a half, three deviations to the ends, what lies beyond is cut, no deviation gives a half."""
    mean, deviation = np.array([1.0, 5.0]), np.array([2.0, 0.0])
    values = np.array([[1.0, 5], [7, 9], [-5, 5], [100, 5], [4, 5]])
    np.testing.assert_allclose(gauss_normalised(values, mean, deviation)[:, 0], [0.5, 1, 0, 1, 0.75])
    np.testing.assert_allclose(gauss_normalised(values, mean, deviation)[:, 1], 0.5)


@given(st.integers(0, 2**32 - 1))
def test_energies_do_not_depend_on_names_or_place(seed):
    """Renumbering the bricks, or moving the layer, changes no energy."""
    rng = np.random.default_rng(seed)
    cells = np.full((6, 7), -1)
    n = 0
    for _ in range(8):
        y, x = rng.integers(0, 5), rng.integers(0, 6)
        block = cells[y : y + rng.integers(1, 3), x : x + rng.integers(1, 3)]
        if (block == -1).all():
            block[:] = n
            n += 1
    colour = rng.choice([RED, BLUE], n).astype(np.int16)
    below = rng.integers(-1, 3, cells.shape)
    order = rng.permutation(n)
    renamed = np.where(cells >= 0, np.argsort(order)[np.maximum(cells, 0)], -1)
    moved = [np.pad(each, ((2, 1), (0, 3)), constant_values=-1) for each in (cells, below)]
    for energy, other, shifted in (
        (minimum_unit_connection(cells, colour), minimum_unit_connection(renamed, colour[order]), None),
        (symmetry(cells, colour), symmetry(renamed, colour[order]), symmetry(moved[0], colour)),
        (
            horizontal_stability(cells, n, None, below),
            horizontal_stability(renamed, n, None, below),
            horizontal_stability(moved[0], n, None, moved[1]),
        ),
    ):
        assert energy == pytest.approx(other)
        assert shifted is None or energy == pytest.approx(shifted)
