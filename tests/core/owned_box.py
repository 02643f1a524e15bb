"""Inventories for tests."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.model.catalogue import load_catalogue

CATALOGUE = load_catalogue()


def owning(lots):
    """Return the counts of an inventory, given {(part number, LDraw code): count}."""
    count = np.zeros(CATALOGUE.exists.shape, dtype=np.int64)
    for (number, code), many in lots.items():
        count[CATALOGUE.part_row(number), CATALOGUE.colour_row(code)] = many
    return count


def used(bricks):
    """Count the bricks of each lot."""
    count = np.zeros(CATALOGUE.exists.shape, dtype=np.int64)
    np.add.at(count, (bricks.part, CATALOGUE.colour_rows(bricks.colour)), 1)
    return count
