"""Pictures of large models show the place that is worked on."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.building import steps_of
from legorize_addon.core.instructions.canvas import Group
from legorize_addon.core.instructions.closeup import AROUND, LEAST, LOCATOR, cut, grown, locator, window_of
from legorize_addon.core.instructions.lattice import FRONT
from legorize_addon.core.instructions.panel_layout import header
from legorize_addon.core.instructions.panels import Panels
from legorize_addon.core.instructions.picture import MM, extent
from legorize_addon.core.instructions.sightlines import Stage
from legorize_addon.core.model import NOBODY, Assembly
from tests.core.any_bricks import CATALOGUE, table
from tests.core.instructions.built import BRICK

ROOM = (277.0, 140.0)


def floor(side=128):
    """Return a square floor with a brick on it."""
    ground = [(BRICK, 4 * x, 2 * y, 0, 0, 4, 0, 0, 0) for x in range(side // 4) for y in range(side // 2)]
    return table([*ground, (BRICK, side - 28, 12, 3, 0, 1, 0, 0, 1)])


def sight_of(bricks):
    """Return what is seen of all bricks."""
    return Stage(bricks, CATALOGUE).sight(np.arange(len(bricks)), FRONT)


def test_small_models_are_shown_whole():
    """There is no window where a stud is 2 mm wide anyway, or where new bricks are seen all over."""
    small, large = floor(48), floor()
    assert window_of(sight_of(small), np.array([len(small) - 1]), ROOM) is None
    assert window_of(sight_of(large), np.arange(len(large)), ROOM) is None
    assert window_of(sight_of(large), np.array([len(large) - 1]), (np.inf, np.inf)) is None


def test_the_window_holds_what_is_new_and_what_is_around_it():
    """It is as large as a quarter of a page, within the picture, and has the new brick with its surroundings in it."""
    sight = sight_of(floor())
    new = np.array([len(sight.free) - 1])
    low, high = window_of(sight, new, ROOM)
    first, last = extent(sight, sight.bricks == new[0])
    whole = extent(sight)
    assert ((high - low) * MM).tolist() == pytest.approx(list(LEAST))
    assert (low >= whole[0]).all()
    assert (high <= whole[1]).all()
    inner = np.clip([first - AROUND / MM, last + AROUND / MM], *whole)
    assert (low <= inner[0] + 1e-6).all()
    assert (high >= inner[1] - 1e-6).all()


def test_what_is_cut_looks_the_same_within_the_window():
    """Every piece within it shows the same brick as before, and far beyond it nothing is drawn."""
    sight = sight_of(floor())
    window = window_of(sight, np.array([len(sight.free) - 1]), ROOM)
    part = cut(sight, window)
    assert part.nearest.size < 0.6 * sight.nearest.size
    m, n, half = np.nonzero(part.bricks != NOBODY)
    shift = part.low - sight.low
    assert (sight.bricks[m + shift[0], n + shift[1], half] == part.bricks[m, n, half]).all()
    low, high = extent(part)
    assert (low <= window[0]).all()
    assert (high >= window[1]).all()
    assert ((window[0] - low) < 200).all()
    assert ((high - window[1]) < 200).all()


def test_a_window_grows_into_the_room_that_there_is():
    """As far as the picture goes, and never smaller."""
    sight = sight_of(floor())
    window = window_of(sight, np.array([len(sight.free) - 1]), ROOM)
    low, high = extent(sight)
    larger = grown(window, sight, np.array([4000.0, 1e9]))
    assert (larger[1] - larger[0]).tolist() == [4000.0, (high - low)[1]]
    assert (larger[0] >= low).all()
    same = grown(window, sight, np.zeros(2))
    assert np.concatenate(same).tolist() == pytest.approx(np.concatenate(window).tolist())


def test_the_locator_fits_and_shows_the_window():
    """The box is in the proportions of the window, inside of the small picture."""
    sight = sight_of(floor())
    new = np.array([len(sight.free) - 1])
    window = window_of(sight, new, ROOM)
    whole, spot, box = locator(sight, new, window)
    assert np.ptp(whole.points, axis=0) == pytest.approx(np.minimum(LOCATOR, np.ptp(whole.points, axis=0)))
    assert (np.ptp(box.points, axis=0) / np.ptp(whole.points, axis=0)).tolist() == pytest.approx(
        ((window[1] - window[0]) / np.subtract(*extent(sight)[::-1])).tolist()
    )
    assert (box.points.min(axis=0) <= spot.points.min(axis=0)).all()
    assert (box.points.max(axis=0) >= spot.points.max(axis=0)).all()


def test_steps_of_large_models_are_shown_in_part():
    """Pictures are cut to their windows, with a locator beside the parts; the first ones, of little, are whole."""
    bricks = floor(96)
    panels = Panels(
        bricks, CATALOGUE, steps_of(Assembly(bricks, CATALOGUE)), np.zeros(len(bricks), bool), (255, 0, 255), ROOM
    )
    first, *_ = panels.of(panels.shots[0])
    assert first.window is None
    [*_, last] = panels.of(panels.shots[-1])
    assert last.window is not None
    picture = panels.picture(last)
    assert isinstance(picture.items[0], Group)
    assert picture.items[0].clip is not None
    assert picture.size.tolist() == last.size.tolist()
    assert panels.locator(last, picture)
    assert not panels.locator(first, panels.picture(first))
    assert header(panels, last, 200).height >= LOCATOR[1]
