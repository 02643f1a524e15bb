"""What a model takes from the owned parts, in sentences."""

from __future__ import annotations

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.report.owned_remarks import remarks_on_owned
from legorize_addon.core.stock.inventory import Owned
from tests.core.any_bricks import table
from tests.core.owned_box import CATALOGUE, owning

MODEL = Assembly(table([(0, 2 * at, 0, 0, 0, 4, 0, 0, 0) for at in range(3)]), CATALOGUE)


def told(count, others=0):
    """Return the remarks for a number of red 1 x 1 bricks."""
    return remarks_on_owned(Owned(owning({("3005", 4): count}), others), MODEL)


def test_all_owned():
    """One sentence."""
    assert told(3) == ("Of the 3 bricks of the model and its supports all are owned.",)


def test_some_missing():
    """Bricks and lots that are missing are counted."""
    assert told(1) == ("Of the 3 bricks of the model and its supports 1 are owned; 2 of 1 lots are missing.",)


def test_parts_that_cannot_be_used():
    """Other parts of the inventory are told."""
    assert told(3, 7)[1] == "7 of the owned parts are no plain bricks or plates, and were not used."


def test_nothing_without_an_inventory():
    """No inventory, no words."""
    assert remarks_on_owned(None, MODEL) == ()
