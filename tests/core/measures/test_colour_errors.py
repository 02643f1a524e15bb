"""How far the colours of bricks are from the surface: nothing where they are right, known differences where not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.colours.difference import ciede2000, lab_from_srgb, linear_from_srgb
from legorize_addon.core.measures.colour_errors import LEAST, colour_errors
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.unit_bricks.wanted_colours import WantedColours
from tests.core.solids import box
from tests.core.textured import painted, rgb_of

CATALOGUE = load_catalogue()
RED, BLUE, YELLOW, BLACK = 4, 1, 14, 0
BOX = painted(box((0, 0, 0), (48, 32, 28.8)), RED)
FAST = Settings(width=6, layout="fast", supports="none")


def difference(one: int, other: int) -> float:
    """Return how different two brick colours look."""
    return float(ciede2000(*lab_from_srgb(rgb_of([one, other]))))


def table(*rows: tuple[str, int, int, int, int]) -> Bricks:
    """Return bricks from part, x, y, z and colour."""
    n = len(rows)
    return Bricks(
        part=np.array([CATALOGUE.part_row(row[0]) for row in rows], np.int16),
        corner=np.array([row[1:4] for row in rows], np.int32).reshape(n, 3),
        turn=np.zeros(n, np.uint8),
        colour=np.array([row[4] for row in rows], np.int16),
        role=np.zeros(n, np.uint8),
        piece=np.zeros(n, np.int16),
        step=np.zeros(n, np.int32),
    )


def wanted(*cells: tuple[int, int, int, int, float], plates: int = 3) -> WantedColours:
    """Return what is wanted, from level, y, x, a brick colour and an area."""
    rows = np.array(cells, np.float64).reshape(-1, 5)
    return WantedColours(
        cell=rows[:, :3].astype(np.int16),
        plates=plates,
        light=linear_from_srgb(rgb_of(rows[:, 3].astype(int))).astype(np.float32).reshape(-1, 3),
        area=rows[:, 4].astype(np.float32),
    )


def test_a_box_of_a_brick_colour_has_no_error():
    """Every brick that shows the surface has error 0, as does the whole; hidden bricks have none at all."""
    build = legorize(BOX, FAST)
    found = colour_errors(build.bricks, CATALOGUE, build.wanted)
    seen = ~np.isnan(found.error)
    assert seen.sum() > 2
    np.testing.assert_allclose(found.error[seen], 0, atol=1e-3)
    assert found.mean == pytest.approx(0, abs=1e-3)
    assert found.error.dtype == np.float32


def test_a_replaced_colour_has_its_difference():
    """Where the user wants blue for red, every brick is as wrong as blue is for red."""
    build = legorize(BOX, replace(FAST, replace_colours=f"{RED}={BLUE}"))
    found = colour_errors(build.bricks, CATALOGUE, build.wanted)
    judged = found.error[~np.isnan(found.error)]
    np.testing.assert_allclose(judged, difference(RED, BLUE), atol=1e-3)
    assert found.mean == pytest.approx(difference(RED, BLUE), abs=1e-3)


def test_bricks_are_judged_by_the_cells_that_they_fill():
    """Each has the difference from its own cell; one that shows nothing, or lies beyond the grid, has none."""
    bricks = table(
        ("3005", 1, 2, 3, RED), ("3005", 2, 2, 3, RED), ("3005", 1, 2, 0, RED), ("3005", -1, 2, 3, RED),
        ("3005", 5, 2, 3, RED),
    )  # fmt: skip
    found = colour_errors(bricks, CATALOGUE, wanted((1, 2, 1, RED, 60.0), (1, 2, 2, YELLOW, 60.0)))
    np.testing.assert_allclose(found.error, [0, difference(RED, YELLOW), *[np.nan] * 3], atol=1e-3)
    np.testing.assert_allclose(found.area, [60, 60, 0, 0, 0])
    assert found.worst == 1
    assert found.mean == pytest.approx(difference(RED, YELLOW) / 2, abs=1e-3)


def test_surface_counts_by_its_area():
    """A brick over two cells is compared with their mean light, and the mean of all goes by what each shows."""
    both = wanted((0, 0, 0, RED, 30.0), (0, 0, 1, BLUE, 90.0), (0, 0, 2, YELLOW, 40.0))
    found = colour_errors(table(("3004", 0, 0, 0, BLUE), ("3005", 2, 0, 0, RED)), CATALOGUE, both)
    light = linear_from_srgb(rgb_of([RED, BLUE])).T @ [0.25, 0.75]
    alone = colour_errors(
        table(("3005", 0, 0, 0, BLUE)),
        CATALOGUE,
        replace(wanted((0, 0, 0, RED, 120.0)), light=light[None].astype(np.float32)),
    )
    np.testing.assert_allclose(found.error, [alone.error[0], difference(YELLOW, RED)], atol=1e-3)
    assert 0 < alone.error[0] < difference(RED, BLUE)
    assert found.mean == pytest.approx((3 * found.error[0] + found.error[1]) / 4, abs=1e-3)


@pytest.mark.parametrize(("plates", "cells"), [(1, (0, 1, 2)), (3, (0,))])
def test_levels_are_plates_or_bricks(plates, cells):
    """A brick covers three levels of plates, or one of bricks; a plate a part of either."""
    surface = wanted(*[(level, 0, 0, YELLOW, 50.0) for level in cells], plates=plates)
    tall, flat = table(("3005", 0, 0, 0, RED)), table(("3024", 0, 0, 1, RED))
    assert colour_errors(tall, CATALOGUE, surface).area.tolist() == [50.0 * len(cells)]
    assert colour_errors(flat, CATALOGUE, surface).area.tolist() == [50.0]


def test_a_sliver_is_not_judged():
    """Less surface than one ray stands for says nothing about a brick."""
    assert pytest.approx((8 / 3) ** 2) == LEAST
    brick = table(("3005", 0, 0, 0, RED))
    for area, judged in ((LEAST * 0.99, False), (LEAST * 1.01, True)):
        assert np.isfinite(colour_errors(brick, CATALOGUE, wanted((0, 0, 0, BLUE, area))).error[0]) == judged


def test_pure_black_is_black():
    """The plastic is as black as the texture, though LDraw shows it as a dark blue-grey."""
    pure = replace(wanted((0, 0, 0, BLACK, 60.0)), light=np.zeros((1, 3), np.float32))
    assert colour_errors(table(("3005", 0, 0, 0, BLACK)), CATALOGUE, pure).error[0] == 0


def test_nothing_to_judge():
    """Without surface, and without bricks, there is no worst brick and no mean."""
    for bricks, surface in ((table(("3005", 0, 0, 0, RED)), wanted()), (table(), wanted((0, 0, 0, RED, 60.0)))):
        found = colour_errors(bricks, CATALOGUE, surface)
        assert found.worst == -1
        assert np.isnan(found.mean)
        assert np.isnan(found.error).all()
