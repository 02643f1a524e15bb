"""What the setting of the surface does: nothing by default; with slopes, a ball comes closer and hangs together."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from legorize_addon.core import slope_stages
from legorize_addon.core.errors import SettingsError
from legorize_addon.core.model import Verdict
from legorize_addon.core.model.unit_grid import Fill
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.progress import Overall, silent
from legorize_addon.core.run import Run
from legorize_addon.core.settings import Settings
from legorize_addon.core.slopes import Slopes
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


@pytest.mark.parametrize(
    ("standing", "tips", "torn", "ties", "laid", "last"),
    [
        ([Verdict.STABLE], False, 1, 0, [], 0),
        ([Verdict.STABLE, Verdict.STABLE], False, 1, 20, [(2, False)], 1),
        ([Verdict.STABLE, Verdict.COLLAPSES], False, 1, 20, [(2, False)], 0),
        ([Verdict.COLLAPSES, Verdict.STABLE], False, 1, 0, [(2, True)], 1),
        ([Verdict.UNDECIDED] * 2, False, 1, 0, [(2, True)], 0),
        ([Verdict.UNDECIDED, Verdict.STABLE], False, 1, 0, [(2, True)], 1),
        ([Verdict.COLLAPSES, Verdict.UNDECIDED], False, 1, 0, [(2, True)], 1),
        ([Verdict.COLLAPSES] * 2, False, 2, 0, [(3, True)], 1),
        ([Verdict.UNDECIDED, Verdict.COLLAPSES], False, 2, 0, [(3, True)], 0),
        ([Verdict.COLLAPSES], True, 1, 0, [], 0),
    ],
)
def test_slopes_where_a_model_comes_apart(monkeypatch, ball, standing, tips, torn, ties, laid, last):
    """Slopes leave that touch what tears, if not most do, and all is filled behind the others; none leave if it tips.

    Where that is in vain, a model of which it is open whether it falls is as good as any.

    Where many ties hold a model, slopes beside them leave if fewer bricks stand as well.
    """
    which = np.flatnonzero(sloped(ball))[[0, 4, -1]]
    asked, numbers = [], iter(range(3))
    # a layout without the last bricks, and one that ties make whole; the first slope lies beside them
    more = np.arange(len(ball.bricks)) if not ties else np.r_[which[1:], np.arange(which[-1] + 1, len(ball.bricks))]

    def found(bricks):
        number = next(numbers)
        tipping = np.array([-1.0 if tips else 1.0])
        nothing = np.zeros((len(bricks), 6))
        return SimpleNamespace(
            standing=standing[number], tipping=tipping, yielding=nothing, statics=None, number=number
        )

    def lay(run, shell, given):
        asked.append((len(given.bricks), given.filled))
        return ball.bricks.take(more), shell

    monkeypatch.setattr(slope_stages, "lay_with_slopes", lay)
    monkeypatch.setattr(slope_stages, "tie_parts", lambda run, bricks, shell: (bricks, shell))
    monkeypatch.setattr(slope_stages, "strengthen_joints", lambda run, bricks, shell: (bricks, shell, found(bricks)))
    monkeypatch.setattr(slope_stages, "torn_by", lambda *_: np.array([[-1, row] for row in which[:torn]]))
    beside = np.isin(np.arange(len(ball.bricks)), which[:1])
    monkeypatch.setattr(slope_stages, "slopes_beside", lambda bricks, weak, catalogue: beside if ties else weak)
    given = Slopes(ball.bricks.take(which), np.ones(3), np.arange(3), np.zeros(3, bool), ball.grid.solid)
    run = Run.of(SETTINGS, Overall({}, silent))
    first = (ball.bricks, ball.hollow, found(ball.bricks))
    made = slope_stages.without_weak_slopes(run, ball.hollow, given, ball.bricks.take(more), first)
    assert asked == laid
    assert made[2].number == last


def test_how_long_ties_are_tried():
    """Rounds are fewer where slopes may leave instead."""
    given, none = (SimpleNamespace(bricks=[0] * count) for count in (3, 0))
    assert slope_stages.tries_of(given) == 7
    assert slope_stages.tries_of(none) is slope_stages.tries_of(None) is None


def test_settled_slopes_keep_their_worth(monkeypatch, ball):
    """Laid once more they are not asked whether they pay, but the least worthy leave first as before."""
    which, known = np.flatnonzero(sloped(ball))[:3], []

    def around(slopes, worth, *_):
        known.append(worth.tolist())
        return slopes, ball.hollow

    monkeypatch.setattr(slope_stages, "paying", lambda *_, **__: pytest.fail("asked again"))
    monkeypatch.setattr(slope_stages, "lay_around_slopes", around)
    given = Slopes(ball.bricks.take(which), np.array([3.0, 1, 2]), np.arange(3), np.ones(3, bool), ball.grid.solid)
    settled = given.settled(np.array([True, False, True]), filled=True)
    slope_stages.lay_with_slopes(Run.of(SETTINGS, Overall({}, silent)), ball.hollow, settled)
    assert known == [[3, 2]]


def test_what_relaxing_sets_loose(monkeypatch, ball):
    """If a model falls apart with less behind its slopes, it is laid once more with all of it."""
    filled = []

    def around(slopes, _worth, _pair, _dear, _catalogue, lay):
        bricks, cells = lay(slopes)
        filled.append((cells.cover == Fill.REQUIRED).sum())
        return (bricks.take(np.arange(0, len(bricks), 2)) if len(filled) == 1 else bricks), cells

    monkeypatch.setattr(slope_stages, "lay_around_slopes", around)
    legorize(sphere(10), replace(SETTINGS, width=20, surface="slopes", slope_price=0.2))
    assert len(filled) == 2
    assert filled[0] < filled[1]
