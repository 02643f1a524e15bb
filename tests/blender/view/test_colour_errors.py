"""Colour errors are shown brick by brick, judged anew after edits, and the worst one is found."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np
import pytest

from legorize_addon.core.colours.difference import ciede2000, lab_from_srgb, linear_from_srgb
from legorize_addon.core.edits.edit import Edit
from legorize_addon.core.errors import BuildError
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.statics.stability import stability
from legorize_addon.core.unit_bricks.colour_votes import CLEAR
from legorize_addon.core.unit_bricks.wanted_colours import WantedColours
from legorize_addon.scene.builds import point_objects
from legorize_addon.scene.collections import show_build
from legorize_addon.scene.colour_errors import COLOUR_ERROR, NO_ERROR, colour_error_of, surface_of
from legorize_addon.scene.model import Model, Source
from legorize_addon.scene.placing import world_from_mm
from legorize_addon.scene.state import state_of
from legorize_addon.ui.panels import LEGORIZE_PT_stability
from legorize_addon.view.colour_errors import (
    NOT_COMPARED,
    NOT_JUDGED,
    RAMP,
    STEPS,
    TOP,
    colour_error_lines,
    colour_errors_shown,
    error_colours,
    row_of,
    show_colour_errors,
    show_worst_colour,
)
from legorize_addon.view.edited import change, show_changed
from legorize_addon.view.heat_map import heat_map_shown, show_heat_map
from legorize_addon.view.kept_view import KeptView
from tests.blender.bricks import content, instances, show, table
from tests.core.textured import rgb_of

pytestmark = pytest.mark.usefixtures("addon")

CATALOGUE = load_catalogue()
ONE = CATALOGUE.part_row("3005")
RED, BLUE, YELLOW = 4, 1, 14
# right, wrong, and above a wrong one that shows nothing
TOWER = table([(ONE, 0, 0, 0, 0, RED), (ONE, 0, 0, 3, 0, BLUE), (ONE, 0, 0, 6, 0, YELLOW)])
SURFACE = WantedColours(
    cell=np.array([[0, 0, 0], [1, 0, 0]], np.int16),
    plates=3,
    light=linear_from_srgb(np.repeat(rgb_of([RED]), 2, axis=0)).astype(np.float32),
    area=np.array([100, 300], np.float32),
)


def difference(one: int, other: int) -> float:
    """Return how different two brick colours look."""
    return float(ciede2000(*lab_from_srgb(rgb_of([one, other]))))


def shown_tower() -> bpy.types.Collection:
    """Show the tower with its surface, and checked."""
    assembly = Assembly(TOWER, CATALOGUE)
    model = Model(assembly, (0.0, 0.0, 0.0), 1.0, 1.0, stability=stability(assembly), wanted=SURFACE)
    return show_build(bpy.context.scene, model, Source("tower"))


def errors(build: bpy.types.Collection) -> list[float]:
    """Return the errors of the bricks from the lowest."""
    return [
        each.value
        for points in sorted(point_objects(build), key=lambda points: points.name)
        for each in points.data.attributes[COLOUR_ERROR].data
    ]


def materials() -> list[str]:
    """Return the materials of what is seen, from the lowest."""
    return [name for _, name, _ in sorted(instances(), key=lambda entry: entry[2][2, 3])]


def test_colours_go_by_the_error() -> None:
    """No error is blue, the ramp ends in red at what is clear at a glance, and more is never bluer."""
    assert TOP == CLEAR
    colours = error_colours()
    found = colours[row_of(np.array([NO_ERROR, 0.0, TOP, 90.0]))]
    np.testing.assert_array_equal(found, [NOT_JUDGED, RAMP[0], RAMP[-1], RAMP[-1]])
    rows = row_of(np.linspace(0, TOP, 1000))
    assert (np.diff(rows) >= 0).all()
    assert set(rows) == set(range(1, STEPS + 1))
    assert rows[-2] < STEPS


def test_each_brick_has_the_colour_of_its_error() -> None:
    """The right one is blue, the wrong one red, the hidden one grey; off is as before."""
    build = shown_tower()
    np.testing.assert_allclose(errors(build), [0, difference(RED, BLUE), NO_ERROR], atol=1e-3)
    before, own = content(), materials()
    show_colour_errors(build, visible=True)
    assert colour_errors_shown(build)
    assert materials() == ["Colour Error 1", f"Colour Error {STEPS}", "Colour Error 0"]
    show_colour_errors(build, visible=False)
    assert (content(), materials()) == (before, own)


def test_it_takes_the_place_of_the_heat_map() -> None:
    """One of the two is on at a time, and the end of the second leaves nothing of both."""
    build = shown_tower()
    before = content()
    show_heat_map(build, visible=True)
    show_colour_errors(build, visible=True)
    assert colour_errors_shown(build)
    assert not heat_map_shown(build)
    # switching off what is not on changes nothing
    show_heat_map(build, visible=False)
    assert colour_errors_shown(build)
    show_heat_map(build, visible=True)
    assert {name.split()[0] for name in materials()} == {"Heat"}
    show_heat_map(build, visible=False)
    assert content() == before


def test_the_panel_says_mean_and_worst() -> None:
    """The mean goes by surface; what cannot be compared is told."""
    wrong = difference(RED, BLUE)
    lines = [text for text, _ in colour_error_lines(shown_tower())]
    assert lines == [
        f"Colour error: {0.75 * wrong:.1f} on average",
        f"Worst: Blue Brick 1 x 1 in layer 2, {wrong:.1f}",
    ]
    assert LEGORIZE_PT_stability.is_registered
    without = show(TOWER)
    assert [text for text, _ in colour_error_lines(without)] == [NOT_COMPARED]
    assert surface_of(without) is None
    for visible in (True, False):
        with pytest.raises(BuildError, match="not compared"):
            show_colour_errors(without, visible=visible)


def test_the_worst_is_shown_without_what_lies_above() -> None:
    """The layers end with the worst brick, and its place is that of the object that was moved."""
    build = shown_tower()
    state_of(build).root.location = (3, 2, 1)
    bpy.context.view_layer.update()
    place = show_worst_colour(bpy.context.scene, build)
    assert state_of(build).top_layer == 2
    np.testing.assert_allclose(place, world_from_mm(build) @ place.__class__((4, 4, 14.4)), atol=1e-5)
    show_colour_errors(build, visible=False)
    assert bpy.ops.legorize.show_worst_colour() == {"FINISHED"}
    assert colour_errors_shown(build)


def test_the_switch_is_on_the_build() -> None:
    """It shows what it can, and does nothing on a build without a texture or a collection that is none."""
    build, without = shown_tower(), show(TOWER, name="plain")
    build.legorize_colour_errors = True
    assert colour_errors_shown(build)
    assert build.legorize_colour_errors
    build.legorize_colour_errors = False
    assert not colour_errors_shown(build)
    for each in (without, bpy.data.collections.new("other")):
        each.legorize_colour_errors = True
        assert not each.legorize_colour_errors


def test_edits_are_judged_by_the_same_surface() -> None:
    """A brick that is painted right has no error any more; the view stays on."""
    build = shown_tower()
    show_colour_errors(build, visible=True)
    painted = Edit("recolour", "3005", 0, (0, 0, 3), RED)
    changed = change(build, [painted])
    shown = show_changed(bpy.context.scene, build, changed, name="tower", detail="high", stability=None)
    assert colour_errors_shown(shown)
    np.testing.assert_allclose(errors(shown), [0, 0, NO_ERROR], atol=0.2)
    assert colour_error_of(shown)["mean"] < 0.2
    kept, given = surface_of(shown), SURFACE
    np.testing.assert_array_equal(kept.cell, given.cell)
    np.testing.assert_allclose(kept.light, given.light, atol=5e-4)
    np.testing.assert_allclose(kept.area, given.area, rtol=1e-3)


def test_a_rebuilt_model_shows_them_again() -> None:
    """What takes the place of a build shows its colour errors too, as far as it has them."""
    build = shown_tower()
    show_colour_errors(build, visible=True)
    kept = KeptView.of([build])
    assert kept.colour_errors
    other, plain = shown_tower(), show(TOWER, name="plain")
    kept.show(bpy.context.scene, other)
    kept.show(bpy.context.scene, plain)
    assert colour_errors_shown(other)
    assert not colour_errors_shown(plain)
    assert not replace(kept, colour_errors=False).colour_errors
