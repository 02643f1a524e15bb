"""Mixtures of palette colours that look like shades that no brick has."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.colours.difference import ciede2000, lab_from_srgb, linear_from_srgb, srgb_from_linear
from legorize_addon.core.colours.dithering import PaletteMixer
from legorize_addon.core.model.catalogue import load_catalogue
from tests.core.afar import difference_from_afar, light_of
from tests.core.textured import rgb_of

CATALOGUE = load_catalogue()
ROW, COLUMN = (axis.ravel() for axis in np.mgrid[:32, :48])


def mixer(codes=None) -> PaletteMixer:
    """Make a mixer of all colours or of some."""
    return PaletteMixer(CATALOGUE.codes if codes is None else np.array(codes, np.int16), CATALOGUE)


def ramp(first, last) -> np.ndarray:
    """Return the light of a gradient from left to right, (32, 48, 3)."""
    share = np.linspace(0, 1, 48)[:, None]
    row = np.asarray(first) * (1 - share) + np.asarray(last) * share
    return linear_from_srgb(np.broadcast_to(np.rint(row).astype(np.uint8), (32, 48, 3)))


def by(kind, mix: PaletteMixer, goal) -> np.ndarray:
    """Mix a picture, (h, w, 3), in one of the two ways."""
    if kind == "diffusion":
        return mix.diffused(goal[:, :, None], np.ones((*goal.shape[:2], 1), bool))[..., 0]
    row, column = (axis.ravel() for axis in np.mgrid[: goal.shape[0], : goal.shape[1]])
    return mix.ordered(goal.reshape(-1, 3), row, column).reshape(goal.shape[:2])


KINDS = pytest.mark.parametrize("kind", ["ordered", "diffusion"])


@KINDS
def test_colours_of_bricks_stay_as_they_are(kind):
    """Where one colour is right there is no pattern."""
    mix = mixer()
    for code in CATALOGUE.codes:
        goal = np.broadcast_to(light_of([code]), (8, 8, 3))
        np.testing.assert_array_equal(by(kind, mix, goal), code)


@KINDS
def test_pure_black_is_black(kind):
    """LDraw's Black is a dark blue-grey, which is farther from pure black than Dark Brown is."""
    np.testing.assert_array_equal(by(kind, mixer(), np.zeros((8, 8, 3))), 0)


@KINDS
def test_half_of_the_light_is_half_of_the_bricks(kind):
    """Black and white share places by light, not by bytes, and by turns."""
    black, white = light_of([0, 15])
    goal = np.broadcast_to((black + white) / 2, (32, 32, 3))
    found = by(kind, mixer([0, 15]), goal)
    assert (found == 15).mean() == pytest.approx(0.5, abs=0.07)
    # by turns, as a checker, but for few places
    assert (found[:, 1:] != found[:, :-1]).mean() > 0.85


@KINDS
@pytest.mark.parametrize("share", [0.25, 0.75])
def test_shares_of_bricks_are_those_of_light(kind, share):
    """A quarter and three quarters of the way between two colours."""
    black, white = light_of([0, 15])
    found = by(kind, mixer([0, 15]), np.broadcast_to(black + share * (white - black), (32, 32, 3)))
    assert (found == 15).mean() == pytest.approx(share, abs=0.07)


@KINDS
@pytest.mark.parametrize("ends", [((0, 0, 0), (255, 255, 255)), ((255, 90, 40), (142, 186, 210))])
def test_gradients_are_nearer_from_afar(kind, ends):
    """Each colour by itself makes steps; mixtures halve the difference at least."""
    goal = ramp(*ends)
    lab = lab_from_srgb(srgb_from_linear(goal[0]))
    plain = np.broadcast_to(_nearest(lab), goal.shape[:2])
    mixed = by(kind, mixer(), goal)
    assert difference_from_afar(mixed, goal) < 0.55 * difference_from_afar(plain, goal)


def _nearest(lab) -> np.ndarray:
    return CATALOGUE.codes[ciede2000(lab[:, None], lab_from_srgb(rgb_of(CATALOGUE.codes))[None]).argmin(axis=1)]


def test_pattern_repeats_every_four_places():
    """The same light gets the same colours four studs on, whatever is beside it."""
    goal = np.broadcast_to(linear_from_srgb(np.array([180, 120, 90], np.uint8)), (len(ROW), 3))
    found = mixer().ordered(goal, ROW, COLUMN)
    np.testing.assert_array_equal(found, mixer().ordered(goal, ROW + 4, COLUMN + 8))
    assert len(np.unique(found)) > 1
    order = np.random.default_rng(0).permutation(len(ROW))
    np.testing.assert_array_equal(found[order], mixer().ordered(goal[order], ROW[order], COLUMN[order]))


def test_diagonals_are_the_same_as_one_place_after_the_other():
    """Errors go on as Floyd and Steinberg say, reckoned place by place."""
    goal = np.random.default_rng(3).random((7, 9, 3)) * 0.6 + 0.2
    mix, light = mixer([4, 15]), light_of([4, 15])
    wanted, codes = np.pad(goal, ((0, 1), (1, 1), (0, 0))), np.empty((7, 9), np.int16)
    for y, x in np.ndindex(7, 9):
        here = np.clip(wanted[y, x + 1], -0.1, 1.1)
        codes[y, x] = by("diffusion", mix, here[None, None])[0, 0]
        rest = here - light[int(codes[y, x] == 15)]
        for down, right, share in ((0, 1, 7), (1, -1, 3), (1, 0, 5), (1, 1, 1)):
            wanted[y + down, x + 1 + right] += share / 16 * rest
    assert len(np.unique(codes)) == 2
    np.testing.assert_array_equal(by("diffusion", mix, goal), codes)


def test_nothing_is_passed_from_what_is_not_there():
    """A hole in a picture takes no part, and of a place's parts only those that are there."""
    goal = np.full((6, 6, 3, 3), 0.4)
    there = np.ones((6, 6, 3), bool)
    there[2:4, 2:4] = False
    there[:, :, 2] = False
    wild = np.where(there[..., None], goal, 5.0)
    mix = mixer([0, 15])
    np.testing.assert_array_equal(mix.diffused(wild, there)[there], mix.diffused(goal, there)[there])


def test_what_no_brick_can_show_is_not_passed_on_for_ever():
    """Beyond a wide strip of a glaring colour the picture is itself again at once."""
    goal = np.concatenate(
        [np.broadcast_to([0.0, 1.0, 0.0], (24, 40, 3)), np.broadcast_to(light_of([71]), (24, 24, 3))], 1
    )
    found = by("diffusion", mixer(), goal)
    assert (found[:, 46:] == 71).mean() > 0.9


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (9, 1), (0, 0)])
def test_small_rasters(shape):
    """A single brick, a row, a column and nothing."""
    goal = np.full((*shape, 3), 0.3)
    assert by("diffusion", mixer(), goal).shape == shape
    assert by("ordered", mixer(), goal).shape == shape


def test_the_pattern_is_that_of_the_plain_rules():
    """Sixteen candidates, each for half of the error so far, by brightness; Bayer's matrix chooses among them."""
    ranks = np.zeros((1, 1), int)
    for _ in range(2):
        ranks = np.block([[4 * ranks, 4 * ranks + 2], [4 * ranks + 3, 4 * ranks + 1]])
    # the luminance of light, from the primaries and the white of sRGB (IEC 61966-2-1)
    x, y = np.array([[0.64, 0.30, 0.15], [0.33, 0.60, 0.06]])
    primaries, white = np.stack([x / y, np.ones(3), (1 - x - y) / y]), np.array([0.3127, 0.329, 0.3583]) / 0.329
    luminance = np.linalg.solve(primaries, white)
    goal = np.random.default_rng(1).random((240, 3))
    mix = mixer([0, 4, 15, 14, 1])
    rows, columns = np.arange(240) // 4, np.arange(240) * 5
    found = mix.ordered(goal, rows, columns)
    for wanted, row, column, code in zip(goal, rows, columns, found, strict=True):
        error, picked = np.zeros(3), []
        for _ in range(16):
            picked.append(int(mix._choice(wanted + 0.5 * error)))
            error += wanted - mix._light[picked[-1]]
        picked.sort(key=lambda each: (mix._light[each] @ luminance, each))
        assert mix._codes[picked[ranks[row % 4, column % 4]]] == code


def test_nearest_colours_are_those_of_six_bits_a_channel():
    """Shades are rounded to 64 levels of each channel before the nearest colour is looked up."""
    srgb = np.random.default_rng(2).integers(0, 256, (300, 3))
    levels = np.floor(srgb * 63 / 255 + 0.5)
    mix, lab = mixer(), lab_from_srgb(np.rint(levels * 255 / 63).astype(np.uint8))
    expected = mix._codes[ciede2000(lab[:, None], mix._lab[None]).argmin(axis=1)]
    np.testing.assert_array_equal(mix.nearest(linear_from_srgb(srgb.astype(np.uint8))), expected)
