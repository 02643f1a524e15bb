"""Tipping over: the place of the weight, and a motion that proves the fall."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.verdict import Verdict
from legorize_addon.core.statics.collapse import is_collapse, least_clutch
from legorize_addon.core.statics.tipping import tipping, toppling
from tests.core.standing import CATALOGUE, downward, equations, judged, table


@given(st.lists(st.tuples(st.integers(-3, 3), st.integers(-3, 3), st.booleans()), min_size=1, max_size=5))
@settings(max_examples=60, deadline=None)
def test_a_fall_is_proven_as_soon_as_the_weight_is_outside(steps: list[tuple[int, int, bool]]) -> None:
    """A wandering tower has a toppling motion that is a proof exactly if its weight is outside of its feet."""
    rows, x, y = [("3001", 20, 20, 0, 0)], 20, 20
    for number, (right, back, turned) in enumerate(steps):
        x, y = x + right, y + min(max(back, -1), 1)
        rows.append(("3001", x, y, 3 * number + 3, int(turned)))
    bricks = table(*rows)
    links, found = contact_graph(bricks, CATALOGUE), equations(bricks)
    if not links.grounded.all():
        return
    inside, motion = tipping(found, links), toppling(found, links)
    assert motion.any() == (inside[0] < 0)
    if abs(inside[0]) > 1e-6:
        assert is_collapse(found, motion) == (inside[0] < 0) == (least_clutch(found) == np.inf)


def test_only_the_body_that_falls_moves() -> None:
    """Of two bodies the one that stands has no motion, and the other turns as one piece."""
    bricks = table(("3003", 0, 0, 0), ("3007", 0, 0, 3), ("3001", 0, 9, 0))
    motion = toppling(equations(bricks), contact_graph(bricks, CATALOGUE)).reshape(-1, 6)
    assert (motion[2] == 0).all()
    np.testing.assert_allclose(motion[0, 3:], motion[1, 3:])
    # about the edge at x = 2: outwards is along +x, and the top turns faster than the foot
    np.testing.assert_allclose(motion[:2, 3:], [[0, 1, 0], [0, 1, 0]], atol=1e-12)
    assert 0 < motion[0, 0] < motion[1, 0]
    assert motion[0, 2] > 0 > motion[1, 2]


def test_what_is_lifted_is_not_turned() -> None:
    """A load that lifts a brick leaves no place on the ground: minus infinity, and no toppling."""
    bricks = table(("3001", 0, 0, 0))
    links, found = contact_graph(bricks, CATALOGUE), equations(bricks, loads=downward(bricks, 0, -1.0))
    assert tipping(found, links).tolist() == [-np.inf]
    assert not toppling(found, links).any()


def test_a_tall_model_that_tips_is_decided() -> None:
    """A tower of 700 bricks on a foot beside its middle is more than a programme takes, and is proven to fall."""
    slab = [("3001", x, y, 3 * z, 0) for z in range(1, 15) for x in range(0, 40, 4) for y in range(0, 10, 2)]
    shifted = [(part, x + 2 * (z // 3 % 2), y + z // 3 % 2, z, turn) for part, x, y, z, turn in slab]
    found = judged(table(("3001", 2, 0, 0, 0), *shifted))
    assert len(found.margin) == 701
    assert found.tipping[0] < 0
    assert found.verdict is Verdict.COLLAPSES
    assert found.check()
    assert len(found.torn) == 0
