"""What the settings mean for a mosaic, and mosaics as a whole."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.errors import LimitError, SettingsError
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY
from legorize_addon.core.mosaic.picture import picture_of
from legorize_addon.core.pipeline import legorize_image
from legorize_addon.core.settings import Settings
from tests.core.mosaic.pictures import painted, ramp


def tops(mosaic):
    """Return the colour that is seen of each stud, bare ones as ``COLOUR_EMPTY``."""
    owner = mosaic.graph.owner[1]
    return np.where(owner >= 0, mosaic.bricks.colour[owner], COLOUR_EMPTY)


def test_a_picture_in_brick_colours_is_what_is_built():
    """Neither turned nor mirrored, as seen from above with the front below; in one piece, and it lies."""
    codes = np.repeat(np.repeat(np.array([[4, 15, 1, 0], [14, 2, 72, 25]], np.int16), 8, axis=0), 4, axis=1)
    mosaic = legorize_image(painted(codes, 2), Settings(width=16))
    np.testing.assert_array_equal(tops(mosaic), codes)
    assert (mosaic.graph.n_components, mosaic.graph.collisions) == (1, 0)
    assert mosaic.stability.stands
    assert mosaic.supports.walk.buildable
    assert mosaic.supports.walk.n_steps > 1


def test_border_and_background():
    """The border is around the image, the background where it is clear."""
    picture = picture_of(np.zeros((2, 2, 3), np.uint8), np.array([[255, 255], [0, 0]], np.uint8))
    settings = Settings(width=8, border=2, border_colour=4, background=14)
    expected = np.full((8, 8), 4)
    expected[2:4, 2:6], expected[4:6, 2:6] = 0, 14
    np.testing.assert_array_equal(tops(legorize_image(picture, settings)), expected)


def test_clear_parts_stay_bare():
    """Without a background the base is seen there."""
    picture = picture_of(np.zeros((2, 2, 3), np.uint8), np.array([[255, 255], [0, 0]], np.uint8))
    mosaic = legorize_image(picture, Settings(width=4))
    assert (tops(mosaic)[2:] == COLOUR_EMPTY).all()
    assert (tops(mosaic)[:2] == 0).all()


def test_a_larger_base_has_the_mosaic_in_its_middle():
    """A border of bare studs is left on both sides."""
    mosaic = legorize_image(painted(np.full((4, 4), 4)), Settings(width=12, mosaic_base="baseplates"))
    there = tops(mosaic) != COLOUR_EMPTY
    assert there.shape == (14, 14) or there.shape == (16, 16)
    assert there[2:14, 2:14].all()
    assert there.sum() == 144


def test_palette_and_number_of_colours():
    """Only the colours of the palette are used, and no more of them than asked for."""
    palette = Settings(width=24, palette="0, 15, 71, 72", dithering="diffusion")
    assert set(np.unique(legorize_image(ramp(), palette).colour)) <= {0, 15, 71, 72}
    few = Settings(width=24, palette="0, 15, 71, 72", colours=2)
    assert len(np.unique(legorize_image(ramp(), few).colour)) == 2


def test_clear_edges_with_texels():
    """The colour that wins on a stud, not the mean; mixing is another matter."""
    picture = painted(np.array([[4, 4, 15, 15, 15, 15]], np.int16), 3)
    wins, mean = (legorize_image(picture, Settings(width=2, fine_texture=kind)) for kind in ("texels", "mean"))
    assert wins.colour.tolist() == [[4, 15]]
    assert mean.colour[0, 0] != 4


def test_size_in_cm():
    """38.4 cm are 48 studs."""
    assert legorize_image(ramp(), Settings(size_by="cm", cm=38.4)).canvas.columns == 48


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"border": 24}, "leaves nothing"),
        ({"size_by": "height"}, "sized by height"),
        ({"background": 6}, "background is 6"),
        ({"base_colour": 6}, "base_colour is 6"),
        ({"border": 1, "border_colour": 6}, "border_colour is 6"),
    ],
)
def test_settings_that_cannot_be(settings, message):
    """Each gets one sentence."""
    with pytest.raises(SettingsError, match=message):
        legorize_image(ramp(), Settings(width=48, **settings))


def test_limits_hold_for_mosaics():
    """A mosaic that is too large is refused before the work begins."""
    with pytest.raises(LimitError, match="limit_size"):
        legorize_image(ramp(), Settings(width=500))


def test_few_pixels_are_told():
    """Neighbouring studs show the same pixel then."""
    assert "2 x 1 pixels" in " ".join(legorize_image(painted(np.array([[4, 15]])), Settings(width=8)).notes)


def test_changed_studs_are_told():
    """The sentence says how many."""
    board = np.where(np.indices((20, 20)).sum(axis=0) % 2, 4, 15)
    mosaic = legorize_image(painted(board), Settings(width=20))
    assert mosaic.covered.changed > 0
    assert f"{mosaic.covered.changed} studs got another colour" in " ".join(mosaic.notes)


def test_steps_can_be_proven():
    """Every step of a mosaic lies on the table."""
    mosaic = legorize_image(ramp(), Settings(width=10, prove_steps=True))
    assert mosaic.proof is not None
    assert not len(mosaic.proof.collapsing)
    assert not len(mosaic.proof.undecided)


def test_the_learned_fill_knows_no_mosaics():
    """It is refused with what to choose instead."""
    with pytest.raises(SettingsError, match="choose one of fast, standard, exact"):
        legorize_image(painted(np.full((4, 4), 4)), Settings(width=8, layout="learned"))


def front(mosaic):
    """Return the colour that is seen of each brick cell of a wall from its front, the lowest row first."""
    owner = mosaic.graph.owner
    seen = np.take_along_axis(owner, (owner >= 0).argmax(axis=1)[:, None], axis=1)[:, 0]
    colour = np.where(seen >= 0, mosaic.bricks.colour[seen], COLOUR_EMPTY).reshape(-1, 3, seen.shape[1])
    assert (colour == colour[:, :1]).all()
    return colour[:, 0]


def test_a_standing_mosaic_shows_the_picture_to_the_front():
    """Neither turned nor mirrored, with a border, in one piece that stands; feet cover its lower corners."""
    codes = np.repeat(np.repeat(np.array([[4, 15, 1, 0], [14, 2, 72, 25]], np.int16), 6, axis=0), 4, axis=1)
    settings = Settings(width=18, border=1, border_colour=71, standing=True)
    mosaic = legorize_image(painted(codes, 12), settings)
    # rows are as high as bricks: fewer of them show the same height
    assert (mosaic.canvas.columns, mosaic.canvas.rows) == (16, 10)
    seen = front(mosaic)
    expected = np.full((12, 18), 71)
    expected[1:-1, 1:-1] = np.repeat(codes[::6], 5, axis=0)
    np.testing.assert_array_equal(seen[2:], expected[2:])
    np.testing.assert_array_equal(seen[:2, 2:-2], expected[:2, 2:-2])
    assert (mosaic.graph.n_components, mosaic.graph.collisions) == (1, 0)
    assert mosaic.stability.stands
    assert mosaic.supports.walk.buildable
    assert "Feet of 1 stud" in mosaic.notes[0]


def test_a_standing_mosaic_stands_around_the_origin():
    """Its middle is there, with feet and without."""
    picture = painted(np.full((8, 8), 4))
    for feet, deep in ((True, 4), (False, 2)):
        mosaic = legorize_image(picture, Settings(width=12, standing=True, feet=feet))
        assert mosaic.graph.owner.shape[1] == deep
        assert mosaic.origin.tolist() == [-48, -4 * deep, 0]
