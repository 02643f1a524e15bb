"""What the setting of the surface does: nothing by default; with slopes, a ball comes closer and hangs together."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core import slope_stages
from legorize_addon.core.errors import SettingsError
from legorize_addon.core.model.unit_grid import Fill
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from tests.core.solids import sphere

SETTINGS = Settings(width=12, supports="none")


@pytest.fixture(scope="module")
def ball():
    """Build a ball with slopes."""
    return legorize(sphere(10), replace(SETTINGS, surface="slopes", slope_price=0.2))


def sloped(build):
    """Tell which bricks are slopes."""
    return np.array([part.sloped for part in build.assembly.catalogue.parts])[build.bricks.part]


def test_a_ball_has_slopes(ball):
    """They are laid without collisions, in colours in which they are made, and all hangs together."""
    assert np.count_nonzero(sloped(ball)) > 8
    assert ball.graph.collisions == 0
    assert ball.graph.n_components == 1
    assert ball.stability.stable
    assert ball.assembly.catalogue.exists_in(ball.bricks.part, ball.bricks.colour).all()
    assert (ball.hollow.cover == Fill.FIXED).any()


def test_slopes_that_do_not_pay(ball, monkeypatch):
    """Which slopes are worth their parts is asked at the price that is set, and the others are not laid."""
    asked = []

    def none(slopes, worth, pair, catalogue, lay, *, price):
        bricks = lay(slopes)
        asked.append((len(slopes), price, np.isfinite(worth).all(), len(bricks) > len(slopes)))
        return np.zeros(len(slopes), bool)

    monkeypatch.setattr(slope_stages, "paying", none)
    build = legorize(sphere(10), replace(SETTINGS, surface="slopes", slope_price=0.2))
    ((count, *others),) = asked
    assert count >= np.count_nonzero(sloped(ball))
    assert others == [0.2, True, True]
    assert not sloped(build).any()


def test_none_by_default():
    """Without the setting, no brick is a slope."""
    assert not sloped(legorize(sphere(10), SETTINGS)).any()


def test_bricks_alone():
    """Without plates, all that is laid is as high as bricks."""
    build = legorize(sphere(10), replace(SETTINGS, surface="slopes", slope_price=0.0, plates="none"))
    assert sloped(build).any()
    assert (build.assembly.height % 3 == 0).all()


def test_the_learned_layout_lays_no_slopes():
    """The learned layout is refused together with slopes."""
    with pytest.raises(SettingsError, match="learned"):
        Settings(surface="slopes", layout="learned")
