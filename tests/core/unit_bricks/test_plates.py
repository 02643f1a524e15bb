"""Where plates stay and where they become bricks: rules of superposition, volume and colour."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.unit_bricks.colour_votes import Ballot
from legorize_addon.core.unit_bricks.plates import Detail, settle_colours, settle_plates, superposed
from tests.core.solids import box, sphere, volume
from tests.core.textured import painted, turned_about_z

MARKED, PLAIN = np.array([True]), np.array([False])
RED, BLUE = 4, 1


def column(*plates: float) -> np.ndarray:
    """Return a single cell column, (3 n, 1, 1)."""
    return np.array(plates, dtype=float)[:, None, None]


def rounded(share, marked=MARKED, gain=1.0) -> list[bool]:
    """Settle a column whose solid plates are those at least half inside, above a solid layer."""
    below, above = column(1, 1, 1), column(0, 0, 0)
    shares = np.concatenate([below, column(*share), above])
    detail = Detail(np.array([True, marked[0], True]), gain)
    return settle_plates(shares >= 0.5, shares, detail)[3:6, 0, 0].tolist()


@pytest.mark.parametrize("share", [(1, 1, 0), (1, 0, 1), (0, 1, 1), (0.9, 0.8, 0.1)])
def test_two_plates_of_three_become_a_brick(share):
    """Two plates and a gap are a brick where two agree (second rule of superposition)."""
    assert rounded(share) == [True] * 3


@pytest.mark.parametrize("share", [(1, 0, 0), (0.6, 0.2, 0.1)])
def test_one_plate_of_three_becomes_nothing(share):
    """One plate is nothing where the two others agree on that."""
    assert rounded(share) == [False] * 3


def test_three_plates_are_a_brick():
    """Three plates in one grid are one brick (first rule)."""
    assert rounded((1, 1, 1)) == [True] * 3


def test_the_third_rule_to_the_letter():
    """Three plates that end at different places become a brick up to the one in the middle; two that agree decide."""
    for ends in product(range(1, 7), repeat=3):
        plates = np.array([[place < end for place in range(8)] for end in ends])[:, None]
        wanted = ends[1] if len(set(ends)) == 3 else sorted(ends)[1]
        for mirrored in (plates, plates[:, :, ::-1]):
            assert superposed(mirrored[None]).sum() == wanted
        shares = np.concatenate([np.ones((3, 1, 8)), plates])
        found = settle_plates(shares >= 0.5, shares, Detail(np.array([True, True]), 1.0, middle=True))[3:]
        np.testing.assert_array_equal(found[:, 0].sum(axis=1), [wanted] * 3)


def test_boundary_is_where_the_middle_plate_ends():
    """Three plates that end at different places of a row become a brick up to the middle one (third rule)."""
    for ends in product(range(1, 7), repeat=3):
        plates = np.array([[place < end for place in range(8)] for end in ends])[:, None]
        shares = np.concatenate([np.ones((3, 1, 8)), plates])
        found = settle_plates(shares >= 0.5, shares, Detail(np.array([True, True]), 1.0))[3:]
        np.testing.assert_array_equal(found[:, 0].sum(axis=1), [sorted(ends)[1]] * 3)


def test_thin_and_hanging_plates_never_become_nothing():
    """A plate that was added though little of it is inside, or that rests on nothing, is filled up instead."""
    thin = column(1, 1, 1, 0.2, 0, 0)
    solid = thin >= 0.2
    assert settle_plates(solid, thin, Detail(np.array([True, True]), 1.0))[3:].all()
    hanging = column(0, 0, 0, 0, 1, 0, 0, 0, 0)
    assert settle_plates(hanging >= 0.5, hanging, Detail(np.ones(3, bool), 1.0))[:, 0, 0].tolist() == [
        0,
        0,
        0,
        1,
        1,
        1,
        0,
        0,
        0,
    ]


def test_plates_stay_where_they_save_enough_volume():
    """Two full plates save a third of a brick against a brick: they stay up to that gain, in marked layers only."""
    assert rounded((1, 1, 0), gain=0.33) == [True, True, False]
    assert rounded((1, 1, 0), gain=0.34) == [True, True, True]
    assert rounded((1, 1, 0.4), gain=0.06) == [True, True, False]
    assert rounded((1, 1, 0.4), gain=0.07) == [True, True, True]
    assert rounded((1, 1, 0), PLAIN, gain=0.0) == [True, True, True]


@settings(max_examples=50)
@given(st.integers(0, 2**32 - 1), st.floats(0, 0.4))
def test_volume_error_is_never_above_the_gain_given_up(seed, gain):
    """Against plates each column errs by less than the least gain more; with a gain of 0 nothing changes."""
    rng = np.random.default_rng(seed)
    share = np.clip(rng.normal(0.5, 0.5, (9, 4, 5)), 0, 1)
    solid = share >= 0.5
    found = settle_plates(solid, share, Detail(np.ones(3, bool), gain))
    error, least = (np.abs(share - each).reshape(3, 3, 4, 5).mean(axis=1) for each in (found, solid))
    assert (error < least + gain + 1e-12).all()
    np.testing.assert_array_equal(settle_plates(solid, share, Detail(np.ones(3, bool), 0.0)), solid)


def ballot(votes, difference=60.0) -> Ballot:
    """Let cells vote for blue and red, which differ by so much."""
    votes = np.array(votes, dtype=float)
    return Ballot(np.array([BLUE, RED], np.int16), votes, votes, difference * (1 - np.eye(2)))


def coloured(colour, votes, gain, marked=MARKED, difference=60.0) -> list[int]:
    """Settle the colours of a column of three visible plates."""
    cells = np.array(colour, np.int16)[:, None, None]
    seen = cells >= 0
    return settle_colours(cells, seen, ballot(votes, difference), Detail(marked, gain))[:, 0, 0].tolist()


def test_colour_border_inside_a_brick():
    """A red plate on two blue ones stays if the third that errs differs by enough, else the brick turns blue."""
    votes = [[1, 0], [1, 0], [0, 1]]
    share = 60 / 22 / 3
    assert coloured([BLUE, BLUE, RED], votes, share * 0.99) == [BLUE, BLUE, RED]
    assert coloured([BLUE, BLUE, RED], votes, share * 1.01) == [BLUE] * 3
    assert coloured([BLUE, BLUE, RED], votes, 0.0, PLAIN) == [BLUE] * 3


def test_colours_that_look_alike_are_no_border():
    """What hardly differs becomes one brick at the default gain, what differs clearly does not."""
    votes = [[1, 0], [1, 0], [0, 1]]
    gain = Settings().plate_gain
    assert len(set(coloured([BLUE, BLUE, RED], votes, gain, difference=10.0))) == 1
    assert len(set(coloured([BLUE, BLUE, RED], votes, gain, difference=60.0))) == 2


def test_hidden_and_missing_plates_make_no_border():
    """Hidden plates agree with every colour; a column with a gap is no brick and keeps its colours."""
    assert coloured([RED, COLOUR_ANY, RED], [[0, 1], [0, 1]], 1.0) == [RED, COLOUR_ANY, RED]
    assert coloured([RED, COLOUR_EMPTY, BLUE], [[0, 1], [1, 0]], 1.0) == [RED, COLOUR_EMPTY, BLUE]


# ---------------------------------------------------------------- whole models


def error_of(mesh, plates) -> float:
    """Return the volume that mesh and model do not share, as a share of the mesh."""
    build = legorize(mesh, Settings(width=24, plates=plates))
    levels = build.grid.colour.reshape(-1, *build.grid.colour.shape[2:]) != COLOUR_EMPTY
    fine = 6
    z, y, x = (np.arange(n * fine) for n in levels.shape)
    centre = build.mesh.vertices.min(axis=0) / 2 + build.mesh.vertices.max(axis=0) / 2
    points = [
        (each + 0.5) / fine * side + low
        for each, side, low in zip((x, y, z), (8, 8, 3.2), build.grid.origin, strict=True)
    ]
    away = [each - middle for each, middle in zip(points, centre, strict=True)]
    distance = np.sqrt(away[2][:, None, None] ** 2 + away[1][:, None] ** 2 + away[0] ** 2)
    inside = distance <= np.ptp(build.mesh.vertices[:, 0]) / 2
    filled = levels.repeat(fine, 0).repeat(fine, 1).repeat(fine, 2)
    return float((inside != filled).sum() / inside.sum())


def test_ball_errs_less_the_more_plates():
    """The volume that a ball's bricks miss or exceed falls from bricks only to plates where they pay to all plates."""
    ball = painted(sphere(24), RED)
    none, pays, every = (error_of(ball, plates) for plates in ("none", "pays", "all"))
    assert every < pays < none
    assert every < 0.8 * none
    assert none - pays > (none - every) / 2


def plates_of(build) -> int:
    """Count cell columns that are neither a whole brick nor empty."""
    there = build.grid.colour != COLOUR_EMPTY
    return int((there.any(axis=1) & ~there.all(axis=1)).sum())


def test_aligned_box_has_no_plates():
    """A box of whole bricks stays one of bricks, whatever is asked for."""
    mesh = painted(box((0, 0, 0), (64, 48, 57.6)), RED)
    for plates in ("none", "pays", "all"):
        build = legorize(mesh, Settings(width=8, plates=plates))
        assert plates_of(build) == 0
        assert build.grid.solid.sum() == 8 * 6 * 6 * 3


def test_ball_and_cone_have_plates_in_marked_layers_only():
    """A ball's and a cone's marked layers hold plates, their others none."""
    cone = turned_about_z([(0, 0), (30, 0), (0, 40)], n=64)
    for mesh in (sphere(24), cone):
        build = legorize(painted(mesh, RED), Settings(width=24, cusp=9.6))
        assert build.cut.marks is not None
        assert build.cut.marks.any.any()
        assert plates_of(build) > 0
        sliced = np.bincount(build.cut.layer, minlength=len(build.grid.colour)) == 3
        there = build.grid.colour != COLOUR_EMPTY
        mixed = (there.any(axis=1) & ~there.all(axis=1)).any(axis=(1, 2))
        assert not (mixed & ~sliced).any()


def test_middle_setting_keeps_volume():
    """The model with plates has the volume of the mesh within a few percent."""
    build = legorize(painted(sphere(24), RED), Settings(width=24))
    assert build.grid.solid.sum() * 64 * 3.2 == pytest.approx(volume(build.mesh), rel=0.04)


@pytest.mark.parametrize("worth", [0.0, 0.1])
@pytest.mark.parametrize(("factor", "plates"), [(1.0, True), (3.0, False)])
def test_where_shape_counts_more_plates_pay_sooner(worth, factor, plates):
    """Two plates of three, which save less than plates have to, become a brick unless their error counts more."""
    share = np.concatenate([column(1, 1, 1), column(1, 1, 0), column(0, 0, 0)])
    factors = np.ones(share.shape)
    factors[3:6] = factor
    found = settle_plates(share >= 0.5, share, Detail(np.array([True] * 3), 0.5, worth), factors)
    assert found[5, 0, 0] == plates


@pytest.mark.parametrize(("weight", "several"), [(0.0, False), (3.0, True)])
def test_where_surface_counts_more_a_column_keeps_its_colours(weight, several):
    """A blue plate in a red column, which differs too little, stays where it counts more."""
    votes = np.array([[0, 1.0], [0, 1.0], [1.0, 0]])
    ballot = Ballot(np.array([BLUE, RED], np.int16), votes, votes, 10.0 * (1 - np.eye(2)), np.full(3, weight))
    colour = np.array([RED, RED, BLUE], np.int16)[:, None, None]
    for worth in (0.0, 0.01):
        found = settle_colours(colour, np.ones((3, 1, 1), bool), ballot, Detail(np.array([True]), 0.3, worth))
        assert (found[2, 0, 0] == BLUE) == several
