"""Numbers are those of the bricks that are seen, in the middle of their upper faces."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np
import pytest

from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.scene.section import Section
from legorize_addon.scene.state import state_of
from legorize_addon.ui.numbers import nearest
from legorize_addon.view.numbers import brick_numbers
from legorize_addon.view.visibility import cut_away
from tests.blender.bricks import show, table

pytestmark = pytest.mark.usefixtures("addon")

CATALOGUE = load_catalogue()
ONE, BEAM = CATALOGUE.part_row("3005"), CATALOGUE.part_row("3008")
WALL = replace(table([(ONE, 0, 0, 0, 0, 4), (BEAM, 0, 0, 3, 0, 4)]), step=np.array([0, 1], dtype=np.int32))


def test_parts_have_their_numbers_on_their_tops() -> None:
    """A 1 x 1 on the ground, and a 1 x 8 on it, in mm below a root that was moved."""
    build = show(WALL)
    state_of(build).root.location.x += 5
    bpy.context.view_layer.update()
    places, numbers = brick_numbers(build, "parts")
    assert numbers == ["3005", "3008"]
    np.testing.assert_allclose(places[1] - places[0], (28.0, 0.0, 9.6), atol=1e-4)


def test_steps_count_from_one() -> None:
    """As in the booklet."""
    assert brick_numbers(show(WALL), "steps")[1] == ["1", "2"]


def test_what_a_section_hides_has_none() -> None:
    """Only the brick whose middle lies before the cut is left."""
    build = show(WALL)
    cut_away(build, Section("z", 0.5))
    assert brick_numbers(build, "parts")[1] == ["3005"]


def test_nearest_are_drawn_last() -> None:
    """Of three places the two nearest ones are left, the nearest one over the other."""
    places = np.array([[0.0, 0.0, 9.0], [0.0, 0.0, 1.0], [0.0, 0.0, 3.0]])
    assert nearest(places, np.zeros(3), 2) == [2, 1]
