"""Everything of the user interface registered with Blender, in the order in which it is needed."""

from __future__ import annotations

from . import (
    animation,
    assets,
    build,
    build_larger,
    duplicates,
    edit_tool,
    edits,
    everything,
    existing,
    expectation,
    export,
    hints,
    instructions,
    learning,
    live,
    looks,
    menus,
    method,
    mosaic,
    numbers,
    palette,
    panels,
    parts,
    preferences,
    properties,
    replacing,
    session,
    tab,
    translations,
    updating,
    weakest,
)

_PARTS = (
    tab, properties, expectation, session, build, build_larger, updating, duplicates, live, export, instructions,
    animation, learning, looks, parts, edits, everything, existing, palette, replacing, edit_tool, panels, mosaic,
    method, menus, preferences, weakest, numbers, hints, assets, translations,
)  # fmt: skip


def register() -> None:
    """Register everything with Blender."""
    for part in _PARTS:
        part.register()


def unregister() -> None:
    """Undo :func:`register`; a running job is stopped."""
    for part in reversed(_PARTS):
        part.unregister()
