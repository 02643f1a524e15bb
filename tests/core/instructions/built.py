"""Small models with the steps in which they are built."""

from __future__ import annotations

from functools import cache

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks, Role
from legorize_addon.core.supports.assembly_plan import AssemblyPlan, plan_assembly
from tests.core.any_bricks import CATALOGUE, table

PART = {part.number: row for row, part in enumerate(CATALOGUE.parts)}
BRICK, LONG, SMALL, PLATE, TALL = (PART[number] for number in ("3001", "3007", "3003", "3020", "30144"))


@cache
def arm() -> AssemblyPlan:
    """Return a post with an arm that needs a support: red, with a yellow end, and bricks below that hang."""
    post = [(BRICK, 0, 2 * y, 3 * z, 0, 4, 0, 0, 0) for z in range(6) for y in range(2)]
    roof = [(LONG, 0, 2 * y, 18, 0, 4, 0, 0, 0) for y in range(2)]
    end = [(BRICK, 6, 2 * y, 21, 0, 14, 0, 0, 0) for y in range(2)]
    tip = [(BRICK, 9, 2 * y, 18, 0, 14, 0, 0, 0) for y in range(2)]
    return plan_assembly(Assembly(table([*post, *roof, *end, *tip]), CATALOGUE), deepest=0)


@cache
def pair() -> AssemblyPlan:
    """Return two pieces, one on the other, each built by itself."""
    lower = [(BRICK, 4 * x, 2 * y, 0, 0, 4, 0, 0, 0) for x in range(2) for y in range(2)]
    upper = [(SMALL, 2 * x, 2 * y, 3, 0, 1, 0, 1, 0) for x in range(4) for y in range(2)]
    roof = [(LONG, 0, 2 * y, 6, 0, 1, 0, 1, 0) for y in range(2)]
    return plan_assembly(Assembly(table([*lower, *upper, *roof]), CATALOGUE), deepest=3)


@cache
def leaning() -> AssemblyPlan:
    """Return a floor with a brick on it from whose end four plates hang: built by itself, it would fall over."""
    floor = [(LONG, 0, 2 * y, 0, 0, 4, 0, 0, 0) for y in range(8)]
    hanging = [(PART["3024"], x, y, 2, 0, 14, 0, 0, 0) for x, y in ((9, 8), (10, 8), (11, 8), (11, 9))]
    return plan_assembly(
        Assembly(table([*floor, (LONG, 4, 8, 3, 0, 1, 0, 0, 0), *hanging]), CATALOGUE), wish="none", deepest=3
    )


def tower() -> Bricks:
    """Return two bricks with plates and a support between them, and a tall one beside."""
    return table(
        [
            (BRICK, 0, 0, 0, 0, 4, 0, 0, 0),
            (PLATE, 0, 0, 3, 0, 1, 0, 0, 1),
            (BRICK, 0, 0, 4, 0, 4, 0, 0, 2),
            (TALL, 4, 0, 0, 0, 15, 0, 0, 0),
            (BRICK, 8, 0, 0, 0, 15, int(Role.SUPPORT_OUTSIDE), 0, 0),
        ]
    )
