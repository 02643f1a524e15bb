"""Forces carried over to a model that is nearly the same."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.statics.transfer import transferred
from tests.core.standing import equations, table

FOOT, TOP = ("3001", 0, 0, 0), ("3003", 1, 0, 3)
BESIDE = ("3001", 4, 0, 0)


def numbered(whole):
    """Return another force at each contact."""
    return np.arange(1.0, 1 + len(whole.contacts.on))


def test_the_same_model_keeps_all_forces() -> None:
    """Every force finds its own place again, at corners of the table that two bricks share as well."""
    whole = equations(table(FOOT, BESIDE, TOP), neighbours=True)
    np.testing.assert_array_equal(transferred(whole, numbered(whole), whole), numbered(whole))


def test_rows_may_change() -> None:
    """Bricks in another order have the same forces at the same points."""
    before, after = equations(table(FOOT, BESIDE, TOP)), equations(table(TOP, FOOT, BESIDE))
    back = transferred(after, transferred(before, numbered(before), after), before)
    np.testing.assert_array_equal(back, numbered(before))


def test_a_new_brick_bears_nothing_and_all_others_what_they_did() -> None:
    """Of a brick more, the contacts are without force, those of another brick at the same corner of the table too."""
    before, after = equations(table(FOOT, TOP)), equations(table(FOOT, TOP, BESIDE))
    found = transferred(before, numbered(before), after)
    new = after.contacts.on == 2
    assert new.any()
    assert (found[new] == 0).all()
    np.testing.assert_array_equal(found[~new], numbered(before))


def test_nothing_to_carry_over() -> None:
    """From a model elsewhere, or none, all forces are 0."""
    before, after = equations(table(FOOT)), equations(table(("3001", 30, 0, 0)))
    assert not transferred(before, numbered(before), after).any()
    floating = equations(table())
    assert not transferred(floating, numbered(floating), after).any()
    assert len(transferred(after, numbered(after), floating)) == 0
