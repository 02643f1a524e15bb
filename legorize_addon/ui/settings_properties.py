"""The settings of the next build as Blender keeps them.

Their properties are generated from :class:`~legorize_addon.core.settings.Settings`,
which alone knows their defaults, limits and texts.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import Field, fields, replace
from typing import Any, Final

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from ..core.errors import SettingsError
from ..core.setting import renamed
from ..core.settings import Settings, choices, setting_type

_OFFERS: Final = bpy.app.version >= (4, 5)
"""Whether texts can offer choices: earlier Blenders crash when they end after a property that does."""


def label(name: str) -> str:
    """Return a word of the code as the panel shows it; units stay as they are."""
    return name if name == "cm" else name.replace("_", " ").capitalize()


def _weights(_group: Any, context: bpy.types.Context, _typed: str) -> list[str]:
    """Offer what the objects to legorize have been painted with; another name, as of what modifiers make, is typed."""
    # these two ask for the settings themselves
    from ..reading import weight_names
    from .requests import chosen_sources

    return weight_names(chosen_sources(context))


def _property(entry: Field[Any]) -> Any:
    """Return the Blender property of a setting."""
    # Blender ends every tooltip with a full stop of its own
    common = {
        "name": entry.metadata["name"],
        "description": entry.metadata["text"].removesuffix("."),
        "default": entry.default,
    }
    if choices(entry):
        meanings = entry.metadata["words"].items()
        items = [(word, label(word), f"{meaning[0].upper()}{meaning[1:]}") for word, meaning in meanings]
        return EnumProperty(items=items, **common)
    kind = setting_type(entry)
    if kind is bool:
        return BoolProperty(**common)
    if kind is str:
        # Blender's file browser gives one name, several are typed
        file = {"subtype": "FILE_PATH"} if entry.metadata["files"] == 1 else {}
        return StringProperty(**common, **file, **({"search": _weights} if entry.name == "weight" and _OFFERS else {}))
    limits = {"min": entry.metadata["low"], "max": entry.metadata["high"]}
    return IntProperty(**common, **limits) if kind is int else FloatProperty(**common, **limits)


def _earlier_property(entry: Field[Any]) -> Any:
    """Return the property under which files of an earlier version have a setting."""
    kind, keywords = _property(entry).function, _property(entry).keywords
    return kind(**{**keywords, "options": {"HIDDEN"}})


LIMITS: Final = tuple(entry.name for entry in fields(Settings) if entry.metadata["group"] == "Limits")
"""Settings that refuse a build, and do not change it."""

RENAMED: Final = [entry for entry in fields(Settings) if entry.metadata["was"]]
"""Settings that had another name in an earlier version."""

LegorizeSettings = type(
    "LegorizeSettings",
    (bpy.types.PropertyGroup,),
    {
        "__doc__": "The settings of the next build.",
        "__annotations__": {entry.name: _property(entry) for entry in fields(Settings)}
        | {entry.metadata["was"]: _earlier_property(entry) for entry in RENAMED},
    },
)


def take_renamed(group: bpy.types.PropertyGroup) -> tuple[str, ...]:
    """Move what a file of an earlier version says to today's names; return what to tell of it."""
    found = [entry for entry in RENAMED if group.is_property_set(entry.metadata["was"])]
    for entry in found:
        setattr(group, entry.name, getattr(group, entry.metadata["was"]))
        group.property_unset(entry.metadata["was"])
    return tuple(renamed(entry) for entry in found)


def settings_of(group: bpy.types.PropertyGroup) -> Settings:
    """Return what the user chose.

    Parameters
    ----------
    group : LegorizeSettings
        The scene's settings.

    Returns
    -------
    Settings
        The same as the command line makes of the same numbers.
    """
    return Settings(**{entry.name: value_of(getattr(group, entry.name)) for entry in fields(Settings)})


def set_settings(group: bpy.types.PropertyGroup, settings: Settings) -> None:
    """Let the scene's settings be others; those at their default are as if they had never been set."""
    for entry in fields(Settings):
        value = getattr(settings, entry.name)
        if value == entry.default:
            group.property_unset(entry.name)
        else:
            setattr(group, entry.name, value)


def kept_settings(stored: Mapping[str, Any]) -> Settings | None:
    """Return the settings that a build keeps.

    Parameters
    ----------
    stored : mapping of str to object
        Names and values.

    Returns
    -------
    Settings or None
        What it does not know, as one of an earlier version, has its default. None where it knows nothing, or what no
        settings can be.
    """
    known = [entry for entry in fields(Settings) if entry.name in stored]
    # a custom property may keep a truth as a number
    truths = {entry.name: bool(stored[entry.name]) for entry in known if setting_type(entry) is bool}
    values = {entry.name: stored[entry.name] for entry in known} | truths
    try:
        return Settings(**values) if values else None
    except SettingsError:
        return None


def take_kept(group: bpy.types.PropertyGroup, stored: Mapping[str, Any]) -> None:
    """Let the scene's settings be those that a build keeps, if it knows them; limits are the user's, not a build's."""
    kept = kept_settings(stored)
    if kept is not None:
        set_settings(group, replace(kept, **{name: getattr(group, name) for name in LIMITS}))


def value_of(value: Any) -> Any:
    """Return the value of a setting, by that of its property."""
    # Blender keeps 32 bits of a float: 3.2 comes back as 3.2000000477
    return float(str(np.float32(value))) if isinstance(value, float) else value
