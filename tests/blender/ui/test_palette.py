"""Swatches change the palette, as a text that the core reads, and show what a model is made of."""

from __future__ import annotations

from types import SimpleNamespace

import bpy
import pytest

from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.scene import found_colours, read_bricks
from legorize_addon.scene.builds import builds
from legorize_addon.ui import palette
from legorize_addon.ui.current import current_build
from legorize_addon.ui.palette import LEGORIZE_OT_palette_colour, codes_of, palette_text, swatch
from legorize_addon.ui.settings_properties import settings_of
from tests.blender.bricks import show, table
from tests.blender.builders import add_table_on_one_leg

pytestmark = pytest.mark.usefixtures("addon")

CATALOGUE = load_catalogue()
ALL = set(CATALOGUE.codes.tolist())


def chosen() -> set[int]:
    """Return the palette of the next build."""
    return codes_of(settings_of(bpy.context.scene.legorize.settings).palette, CATALOGUE)


def test_a_click_takes_a_colour_out_and_in_again() -> None:
    """All but one are written; with all of them the setting is empty again."""
    assert chosen() == ALL
    assert bpy.ops.legorize.palette_colour(code=4) == {"FINISHED"}
    assert chosen() == ALL - {4}
    assert bpy.ops.legorize.palette_colour(code=4) == {"FINISHED"}
    assert bpy.context.scene.legorize.settings.palette == ""


def test_the_last_colour_stays() -> None:
    """A palette of nothing would mean all colours."""
    bpy.context.scene.legorize.settings.palette = "4"
    assert bpy.ops.legorize.palette_colour(code=4) == {"CANCELLED"}
    assert chosen() == {4}


def test_with_shift_a_colour_is_alone() -> None:
    """One click leaves nothing but this colour; without Shift it is added to the others."""
    operator = SimpleNamespace(code=15, execute=lambda context: {"PASSED"})
    invoke = LEGORIZE_OT_palette_colour.invoke
    assert invoke(operator, bpy.context, SimpleNamespace(shift=False)) == {"PASSED"}
    assert invoke(operator, bpy.context, SimpleNamespace(shift=True)) == {"FINISHED"}
    assert chosen() == {15}
    assert bpy.ops.legorize.palette_all() == {"FINISHED"}
    assert chosen() == ALL


def test_colours_of_the_model_become_the_palette() -> None:
    """Those of its parts, no others; without a table of parts the button is off."""
    build = show(table([(0, 0, 0, 0, 0, 4), (0, 1, 0, 0, 0, 15)]))
    assert not bpy.ops.legorize.palette_of_build.poll()
    bpy.ops.legorize.list_parts()
    assert len(builds(bpy.context.scene)) == 1
    assert bpy.ops.legorize.palette_of_build() == {"FINISHED"}
    assert chosen() == {4, 15}
    assert build.legorize_lots


def test_texts_name_the_colours() -> None:
    """A text gives the colours that it was made of; what names no colour gives none."""
    assert palette_text({15, 4}, CATALOGUE) == "4, 15"
    assert codes_of(palette_text({15, 4}, CATALOGUE), CATALOGUE) == {4, 15}
    assert codes_of("no colour", CATALOGUE) == set()


def test_tooltips_name_the_colour_and_say_what_is_hard_to_buy() -> None:
    """Of a usual colour nothing more is said."""
    hard = palette.rare(CATALOGUE)
    describe = LEGORIZE_OT_palette_colour.description
    red = describe(bpy.context, SimpleNamespace(code=4))
    assert red.startswith("Red (4). Click")
    assert not hard[4]
    code = next(code for code, is_hard in hard.items() if is_hard)
    assert "Few parts" in describe(bpy.context, SimpleNamespace(code=code))


def test_swatches_have_the_colours() -> None:
    """Each colour has a picture of its own, filled with it; without a window Blender gives them no number."""
    for _ in range(2):
        for colour in CATALOGUE.colours:
            swatch(colour)
    assert set(palette._swatches()) == {str(code) for code in ALL}
    red = CATALOGUE.colours[CATALOGUE.colour_row(4)]
    pixel = palette._swatches()["4"].icon_pixels_float[:3]
    assert [round(255 * channel) for channel in pixel] == list(red.rgb)


def test_greys_come_first_and_hues_in_order() -> None:
    """Black before white, red before green before blue."""
    ranked = [colour.name for colour in sorted(CATALOGUE.colours, key=palette._rainbow)]
    order = [ranked.index(name) for name in ("Black", "White", "Red", "Green", "Blue")]
    assert order == sorted(order)


def test_a_found_colour_is_replaced() -> None:
    """A model keeps what was found in the texture; what is chosen for it is in the setting, and in the next model."""
    add_table_on_one_leg()
    settings = bpy.context.scene.legorize.settings
    settings.width, settings.layout = 8, "fast"
    bpy.ops.legorize.build()
    first = found_colours(current_build(bpy.context.scene))[0]
    assert first.nearest == first.code
    other = 4 if first.code != 4 else 15
    assert bpy.ops.legorize.replace_colour(code=first.nearest, by=other) == {"FINISHED"}
    bpy.ops.legorize.build()
    build = current_build(bpy.context.scene)
    again = found_colours(build)[0]
    assert (again.nearest, again.code, again.rgb) == (first.nearest, other, first.rgb)
    assert other in read_bricks(build).colour
    assert bpy.ops.legorize.replace_colour(code=first.nearest, by=first.nearest) == {"FINISHED"}
    assert settings.replace_colours == ""
    with pytest.raises(RuntimeError, match="Colour 12345"):
        bpy.ops.legorize.replace_colour(code=first.nearest, by=12345)
