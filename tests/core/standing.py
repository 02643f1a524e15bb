"""Small models for the tests of statics and stability."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.statics.forces import GRAVITY, statics
from legorize_addon.core.statics.stability import Effort, stability
from scripts.benchmarks.stablelego import placed

CATALOGUE = load_catalogue()


def table(*rows):
    """Return bricks, given part number, x, y, plate and turn of each."""
    return placed([(*row, 0)[:5] for row in rows], CATALOGUE)


def equations(bricks, **options):
    """Return the balance of bricks."""
    return statics(Assembly(bricks, CATALOGUE), **options)


def judged(bricks, **options):
    """Return whether bricks stand."""
    effort = {name: options.pop(name) for name in Effort.__slots__ if name in options}
    return stability(Assembly(bricks, CATALOGUE), effort=Effort(**effort), **options)


def weight(*numbers):
    """Return the weight of parts in N."""
    return sum(GRAVITY * CATALOGUE.parts[CATALOGUE.part_row(number)].mass / 1000 for number in numbers)


def downward(bricks, row, newtons):
    """Return a load on one brick."""
    loads = np.zeros((len(bricks), 3))
    loads[row, 2] = -newtons
    return loads
