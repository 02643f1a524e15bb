"""What a user has for all files: palette, prices and own parts that new files begin with, and where help is."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, Final

import bpy
from bpy.app.handlers import persistent
from bpy.app.translations import pgettext_n as n
from bpy.app.translations import pgettext_rpt as rpt
from bpy.props import BoolProperty, StringProperty

from ..core.settings import Settings

PACKAGE: Final = __package__.removesuffix(".ui").removesuffix(".legorize_addon")
"""Name under which Blender knows the add-on: as an extension, that of the package around this one."""

KEPT: Final = ("palette", "prices", "owned")
"""Settings that new files take from the preferences."""

_TEXTS: Final = {entry.name: entry.metadata for entry in fields(Settings)}


UNKNOWN: Final = n("Install Legorize as an extension first: Blender keeps preferences only of those.")


def _preference(name: str) -> Any:
    """Return the property of a kept setting."""
    text = _TEXTS[name]["text"].removesuffix(".")
    subtype = {"subtype": "FILE_PATH"} if _TEXTS[name]["files"] == 1 else {}
    return StringProperty(name=_TEXTS[name]["name"], description=text, **subtype)


class LegorizePreferences(bpy.types.AddonPreferences):
    """The panel in Blender's preferences."""

    bl_idname = PACKAGE
    __annotations__ = {name: _preference(name) for name in KEPT} | {
        "show_hints": BoolProperty(
            name="Show hints", description="Say in the panel what to do first, while a file has no model", default=True
        )
    }

    def draw(self, context: bpy.types.Context) -> None:
        """Draw what new files begin with."""
        self.layout.use_property_split = True
        self.layout.label(text="New files begin with:")
        for name in KEPT:
            self.layout.prop(self, name)
        self.layout.operator(LEGORIZE_OT_keep_preferences.bl_idname)
        self.layout.operator(LEGORIZE_OT_take_preferences.bl_idname)
        self.layout.prop(self, "show_hints")


def preferences() -> Any:
    """Return the preferences; None where Blender does not know the add-on by its name, as in scripts."""
    entry = bpy.context.preferences.addons.get(PACKAGE)
    return entry.preferences if entry else None


def take(scene: bpy.types.Scene, kept: Any) -> None:
    """Let a scene have the kept settings, as far as it has none of its own."""
    group = scene.legorize.settings
    for name in KEPT:
        if getattr(kept, name) and not group.is_property_set(name):
            setattr(group, name, getattr(kept, name))


class LEGORIZE_OT_keep_preferences(bpy.types.Operator):
    """Keep some of the scene's settings for new files."""

    bl_idname = "legorize.keep_preferences"
    bl_label = "Use Those of This Scene"
    bl_description = "Let new files begin with the palette, price file and owned parts of this scene"
    bl_options = {"REGISTER", "INTERNAL"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Copy them."""
        kept = preferences()
        if kept is None:
            self.report({"ERROR"}, rpt(UNKNOWN))
            return {"CANCELLED"}
        for name in KEPT:
            setattr(kept, name, getattr(context.scene.legorize.settings, name))
        context.preferences.is_dirty = True
        return {"FINISHED"}


class LEGORIZE_OT_take_preferences(bpy.types.Operator):
    """Give the scene the settings that new files begin with."""

    bl_idname = "legorize.take_preferences"
    bl_label = "Set Them in This Scene"
    bl_description = "Set the palette, price file and owned parts of this scene to those above"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Copy them."""
        kept, group = preferences(), context.scene.legorize.settings
        if kept is None:
            self.report({"ERROR"}, rpt(UNKNOWN))
            return {"CANCELLED"}
        for name in KEPT:
            group.property_unset(name)
        take(context.scene, kept)
        return {"FINISHED"}


@persistent
def _begin(*arguments: Any) -> None:
    """Give a new file what the preferences have for it."""
    kept = preferences()
    if kept is not None and not bpy.data.filepath:
        for scene in bpy.data.scenes:
            take(scene, kept)


classes = (LegorizePreferences, LEGORIZE_OT_keep_preferences, LEGORIZE_OT_take_preferences)
_register_classes, _unregister_classes = bpy.utils.register_classes_factory(classes)


def register() -> None:
    """Register the preferences, and what new files take from them."""
    _register_classes()
    bpy.app.handlers.load_post.append(_begin)


def unregister() -> None:
    """Undo :func:`register`."""
    bpy.app.handlers.load_post.remove(_begin)
    _unregister_classes()
