"""Our operators in Blender's own menus, where people look for them and where the menu search (F3) finds them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import bpy

from .build import LEGORIZE_OT_build
from .everything import LEGORIZE_OT_export_folder
from .existing import LEGORIZE_OT_open_ldraw
from .export import LEGORIZE_OT_export_ldr, LEGORIZE_OT_export_mpd
from .instructions import LEGORIZE_OT_booklet, LEGORIZE_OT_layer_maps
from .parts import LEGORIZE_OT_export_list

Entry = tuple[type[bpy.types.Operator], str, str]

ENTRIES: Final[dict[str, tuple[Entry, ...]]] = {
    "VIEW3D_MT_object": ((LEGORIZE_OT_build, "Legorize", "MOD_BUILD"),),
    "TOPBAR_MT_file_import": ((LEGORIZE_OT_open_ldraw, "LDraw Brick Model (.ldr/.mpd)", "NONE"),),
    "TOPBAR_MT_file_export": (
        (LEGORIZE_OT_export_ldr, "LDraw Brick Model (.ldr)", "NONE"),
        (LEGORIZE_OT_export_mpd, "LDraw with Building Steps (.mpd)", "NONE"),
        (LEGORIZE_OT_export_list, "Brick Parts List (.csv/.xml)", "NONE"),
        (LEGORIZE_OT_booklet, "Brick Building Instructions (.pdf)", "NONE"),
        (LEGORIZE_OT_layer_maps, "Brick Layer Maps (.svg)", "NONE"),
        (LEGORIZE_OT_export_folder, "Brick Model, Everything", "NONE"),
    ),
}
"""What stands at the end of which of Blender's menus, with its text and icon there."""


def _drawing(entries: tuple[Entry, ...]) -> Callable[[Any, bpy.types.Context], None]:
    """Return the function that draws entries at the end of a menu."""

    def draw(self: Any, context: bpy.types.Context) -> None:
        """Draw them after a line."""
        self.layout.separator()
        # invoked, so that files are asked for
        self.layout.operator_context = "INVOKE_DEFAULT"
        for operator, text, icon in entries:
            self.layout.operator(operator.bl_idname, text=text, icon=icon)

    return draw


_DRAWN: Final = {menu: _drawing(entries) for menu, entries in ENTRIES.items()}


def register() -> None:
    """Add to the menus."""
    for menu, draw in _DRAWN.items():
        getattr(bpy.types, menu).append(draw)


def unregister() -> None:
    """Undo :func:`register`."""
    for menu, draw in _DRAWN.items():
        getattr(bpy.types, menu).remove(draw)
