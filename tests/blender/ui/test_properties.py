"""The settings in Blender are the core's settings; the view's properties work on the build of the panel."""

from __future__ import annotations

from dataclasses import fields
from types import SimpleNamespace

import bpy
import numpy as np
import pytest

import legorize_addon
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.settings import Settings, choices
from legorize_addon.scene.builds import layers_of
from legorize_addon.scene.collections import clear_build
from legorize_addon.scene.state import BUILD_KEY
from legorize_addon.ui import panels
from legorize_addon.ui.current import current_build
from legorize_addon.ui.settings_properties import settings_of, take_renamed
from tests.blender.bricks import content, instances, show, table

pytestmark = pytest.mark.usefixtures("addon")

BY_NAME = {entry.name: entry for entry in fields(Settings)}


@pytest.fixture
def view() -> bpy.types.PropertyGroup:
    """Return the scene's properties."""
    return bpy.context.scene.legorize


def tower(n: int, **changes) -> bpy.types.Collection:
    """Show a tower of n small bricks."""
    return show(table([(0, 0, 0, 3 * layer, 0, 4) for layer in range(n)]), **changes)


def test_defaults_are_the_cores(view) -> None:
    """An untouched scene gives the core's defaults, floats to the last digit."""
    assert settings_of(view.settings) == Settings()


def test_properties_are_those_of_the_core(view) -> None:
    """Blender has the core's settings in their order, with their limits, words and texts."""
    others = {"rna_type", "name", *(entry.metadata["was"] for entry in BY_NAME.values())}
    found = [entry for entry in view.settings.bl_rna.properties if entry.identifier not in others]
    assert [entry.identifier for entry in found] == list(BY_NAME)
    for entry in found:
        setting = BY_NAME[entry.identifier]
        assert setting.metadata["text"] == f"{entry.description}."
        assert setting.metadata["name"] == entry.name
        if choices(setting):
            assert tuple(item.identifier for item in entry.enum_items) == choices(setting)
            assert len({item.description for item in entry.enum_items}) == len(entry.enum_items)
        elif entry.type in ("INT", "FLOAT"):
            assert (entry.hard_min, entry.hard_max) == pytest.approx(
                (setting.metadata["low"], setting.metadata["high"])
            )


def test_floats_come_back_as_they_were_typed(view) -> None:
    """Blender's 32 bits do not leak: a number of up to six digits is the same number in the core."""
    for value in np.random.default_rng(0).uniform(0.1, 9.6, 20).round(4).tolist():
        view.settings.cusp = value
        assert settings_of(view.settings).cusp == value


def test_settings_of_an_earlier_version_are_taken(view) -> None:
    """A value under an earlier name counts under today's name, is told once, and is gone from where it was."""
    view.settings.hold = 0.5
    assert take_renamed(view.settings) == ("The setting hold is now called clutch: its value was used.",)
    assert settings_of(view.settings).clutch == 0.5
    assert take_renamed(view.settings) == ()
    view.settings.property_unset("clutch")
    assert settings_of(view.settings) == Settings()


def test_limits_are_kept(view) -> None:
    """Blender keeps numbers within the limits, and what it keeps the core takes."""
    for name, setting in BY_NAME.items():
        for limit, beyond in ((setting.metadata["low"], -(2**31)), (setting.metadata["high"], 2**31 - 1)):
            if limit is not None:
                setattr(view.settings, name, beyond)
                assert getattr(settings_of(view.settings), name) == pytest.approx(limit)


def test_addon_comes_and_goes() -> None:
    """Registering can be undone and done again; nothing of it stays on the scene meanwhile."""
    legorize_addon.unregister()
    assert not hasattr(bpy.types.Scene, "legorize")
    assert not hasattr(bpy.types, "LEGORIZE_PT_main")
    legorize_addon.register()
    assert hasattr(bpy.types.Scene, "legorize")


def test_each_setting_has_its_place() -> None:
    """Every setting is in just one panel, in the panel of its group."""
    label = {"Legorize": "Size"}  # beside the button
    shown = [
        (label.get(panel.bl_label, panel.bl_label), entry.name)
        for panel in panels.classes
        for entry in getattr(panel, "entries", ())
    ]
    assert shown == [(entry.metadata["group"], entry.name) for entry in BY_NAME.values()]


def test_panel_is_about_one_build(view) -> None:
    """The panel shows the chosen build, else the newest, else none."""
    scene = bpy.context.scene
    assert current_build(scene) is None
    first, second = tower(1, name="a"), tower(2, name="b")
    assert current_build(scene) == second
    view.build = first
    assert current_build(scene) == first
    clear_build(scene, first)
    assert view.build is None
    assert current_build(scene) == second


def test_top_layer_keeps_to_the_model(view) -> None:
    """The slider begins at the top, goes no higher than the model and no lower than its first layer."""
    build = tower(5)
    assert view.top_layer == 5
    view.top_layer = 2
    assert view.top_layer == 2
    assert [layer.hide_render for layer in layers_of(build)] == [False, False, True, True, True]
    view.top_layer = 99
    assert view.top_layer == 5
    view.top_layer = -3
    assert view.top_layer == 1


def test_one_layer_alone(view) -> None:
    """The layers below it are hidden too; the slider then walks through the layers."""
    build = tower(4)
    view.top_layer, view.single_layer = 2, True
    assert [layer.hide_render for layer in layers_of(build)] == [True, False, True, True]
    view.top_layer = 3
    assert [layer.hide_render for layer in layers_of(build)] == [True, True, False, True]
    view.single_layer = False
    assert [layer.hide_render for layer in layers_of(build)] == [False, False, False, True]


def test_section_keeps_to_its_build(view) -> None:
    """The cut is kept with the build: another build has its own, and the panel shows that of its build."""
    first = show(table([(0, x, 0, 0, 0, 4) for x in range(10)]), name="a")
    assert (view.section_axis, view.section_at, view.section_flip) == ("none", 0.5, False)
    view.section_at = 0.2
    assert len(instances()) == 10
    view.section_axis = "x"
    assert max(matrix[0, 3] for _, _, matrix in instances()) < 16
    assert len(instances()) == 2
    view.section_flip = True
    assert len(instances()) == 8
    second = show(table([(0, 0, y, 0, 0, 4) for y in range(10)]), name="b")
    view.build = second
    assert view.section_axis == "none"
    view.section_axis, view.section_at = "y", 0.4
    assert len(instances()) == 8 + 4
    view.build = first
    assert (view.section_axis, view.section_at, view.section_flip) == ("x", pytest.approx(0.2), True)
    view.section_axis = "none"
    assert len(instances()) == 10 + 4


def test_roles_follow(view) -> None:
    """There is a switch for each role; those of roles that the build does not have are off and do nothing."""
    show(table([(0, x, 0, 0, 0, 4, role) for x, role in enumerate((Role.SHELL, Role.PLATE, Role.PLATE))]))
    assert {role.name.lower() for role in Role} <= set(view.roles.bl_rna.properties.keys())
    assert [role for role in Role if getattr(view.roles, role.name.lower())] == [Role.SHELL, Role.PLATE]
    view.roles.plate = False
    assert len(instances()) == 1
    view.roles.offset = True
    assert not view.roles.offset
    view.roles.plate = True
    assert len(instances()) == 3


def test_detail_and_source_follow(view) -> None:
    """The other properties act on the build at once."""
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.object
    show(table([(0, x, 0, 0, 0, 4) for x in range(10)]), cube)
    view.detail = "low"
    assert {mesh["legorize_mesh"] for mesh, _, _ in instances()} == {"3005 low"}
    view.show_sources = True
    assert not cube.hide_viewport
    view.show_sources = False
    assert cube.hide_viewport


def test_properties_without_a_build_do_nothing(view) -> None:
    """Turning knobs in an empty scene changes nothing."""
    before = content()
    view.top_layer, view.section_axis, view.detail, view.show_sources = 3, "y", "low", True
    view.section_at, view.section_flip, view.roles.shell = 0.1, True, False
    assert content() == before
    assert (view.section_axis, view.section_at, view.roles.shell) == ("none", 0.5, False)
    assert view.top_layer == 1


class Layout:
    """A layout that notes which properties are drawn."""

    def __init__(self) -> None:
        self.drawn: list[str] = []
        self.buttons: list[tuple[str, SimpleNamespace]] = []

    def prop(self, group: bpy.types.PropertyGroup, name: str, **_: object) -> None:
        """Note a property, which has to be there."""
        getattr(group, name)
        self.drawn.append(name)

    def operator(self, name: str, **_: object) -> SimpleNamespace:
        """Note a button; return what it is pressed with."""
        self.drawn.append(name)
        self.buttons.append((name, SimpleNamespace()))
        return self.buttons[-1][1]

    def label(self, **_: object) -> None:
        """Draw a text."""

    def row(self, **_: object) -> Layout:
        """Return the same layout."""
        return self

    column = row


@pytest.mark.parametrize(("known", "pieces"), [(False, 1), (True, 1), (True, 2)])
def test_layers_panel_offers_what_the_build_knows(known: bool, pieces: int) -> None:
    """There is a slider of steps if they are known, and one to take pieces apart if there are several."""
    bricks = table([(0, 0, 0, 3 * z, 0, 4, 0, z % pieces, z) for z in range(4)])
    build = show(bricks)
    if known:
        build[BUILD_KEY]["building"] = {"steps": 4, "pieces": pieces}
    panel = panels.LEGORIZE_PT_layers
    drawing = SimpleNamespace(layout=Layout())
    drawing._draw_building = lambda *arguments: panel._draw_building(drawing, *arguments)
    region, preferences = SimpleNamespace(width=300), SimpleNamespace(system=SimpleNamespace(ui_scale=1.0))
    panel.draw(drawing, SimpleNamespace(scene=bpy.context.scene, region=region, preferences=preferences))
    assert "legorize.plan_steps" in drawing.layout.drawn
    assert ("step" in drawing.layout.drawn) == ("by_steps" in drawing.layout.drawn) == known
    assert ("legorize.booklet" in drawing.layout.drawn) == ("legorize.layer_maps" in drawing.layout.drawn) == known
    assert ("legorize.animate" in drawing.layout.drawn) == ("legorize.film" in drawing.layout.drawn) == known
    assert ("exploded" in drawing.layout.drawn) == (pieces > 1)
    assert {"top_layer", "section_axis", "shell", "detail"} <= set(drawing.layout.drawn)


def test_export_panel_has_the_wanted_list() -> None:
    """One of the buttons writes the list that most people buy by, without a choice in the file browser."""
    show(table([(0, 0, 0, 0, 0, 4)]))
    layout = Layout()
    panels.LEGORIZE_PT_export.draw(SimpleNamespace(layout=layout), SimpleNamespace(scene=bpy.context.scene))
    kinds = [vars(pressed) for name, pressed in layout.buttons if name == "legorize.export_list"]
    assert kinds == [{}, {"kind": "bricklink"}]


def test_figures_are_sentences_of_numbers() -> None:
    """The result panel's lines give the size in studs and in cm."""
    build = show(table([(0, x, 0, 0, 0, 4) for x in range(10)]))
    summary = dict(build[BUILD_KEY]["summary"]) | {"studs_x": 10, "studs_y": 5, "layers": 4, "mass": 12.4}
    assert panels._figures(summary)[2:] == ("10 x 5 studs, 4 layers", "8.0 x 4.0 x 3.8 cm")
    assert panels._figures(summary)[0] == "10 bricks, 12 g"
