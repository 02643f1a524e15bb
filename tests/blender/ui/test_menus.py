"""Our operators stand in Blender's own menus, and leave them again."""

from __future__ import annotations

from types import SimpleNamespace

import bpy
import pytest

import legorize_addon
from legorize_addon.ui import menus

pytestmark = pytest.mark.usefixtures("addon")


class Menu:
    """Notes which operators are drawn, and how they are called."""

    def __init__(self) -> None:
        self.drawn: list[str] = []
        self.operator_context = ""
        self.layout = self

    def operator(self, name: str, **_: object) -> SimpleNamespace:
        """Note an operator."""
        assert self.operator_context == "INVOKE_DEFAULT"
        self.drawn.append(name)
        return SimpleNamespace()

    def separator(self) -> None:
        """Draw a line."""


@pytest.mark.parametrize("menu", menus.ENTRIES)
def test_entries_are_drawn(menu: str) -> None:
    """Each entry calls an operator that is there."""
    drawing = Menu()
    menus._DRAWN[menu](drawing, bpy.context)
    assert drawing.drawn == [operator.bl_idname for operator, _, _ in menus.ENTRIES[menu]]
    assert all(hasattr(bpy.types, operator.__name__) for operator, _, _ in menus.ENTRIES[menu])


@pytest.mark.parametrize("menu", menus.ENTRIES)
def test_nothing_of_ours_stands_there_twice(menu: str) -> None:
    """No other module of ours draws into the same menus."""
    ours = [each for each in getattr(bpy.types, menu).draw._draw_funcs if each.__module__.startswith("legorize_addon")]
    assert ours == [menus._DRAWN[menu]]


def test_menus_are_left_as_they_were() -> None:
    """Switched off, nothing of ours is called any more."""
    entries = {name: getattr(bpy.types, name).draw._draw_funcs for name in menus.ENTRIES}
    assert all(menus._DRAWN[name] in found for name, found in entries.items())
    legorize_addon.unregister()
    left = [name for name in entries if menus._DRAWN[name] in getattr(bpy.types, name).draw._draw_funcs]
    legorize_addon.register()
    assert left == []
