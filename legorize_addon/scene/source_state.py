"""Objects that a build hides, and how they were hidden before."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import bpy


@dataclass(frozen=True, slots=True, eq=False)
class SourceState:
    """An object that a build was made of, and how it was hidden before.

    Attributes
    ----------
    source : bpy.types.Object
    hide_viewport, hide_render : bool
    """

    source: bpy.types.Object
    hide_viewport: bool
    hide_render: bool

    @classmethod
    def of(cls, source: bpy.types.Object) -> SourceState:
        """Return an object as it is hidden now."""
        return cls(source, source.hide_viewport, source.hide_render)

    @classmethod
    def read(cls, stored: Mapping[str, Any]) -> SourceState | None:
        """Return what :meth:`stored` wrote; None where the object is gone or the form is another one."""
        source = stored.get("object")
        if not isinstance(source, bpy.types.Object):
            return None
        return cls(source, bool(stored.get("hide_viewport")), bool(stored.get("hide_render")))

    def stored(self) -> dict[str, Any]:
        """Return plain values for a custom property."""
        return {"object": self.source, "hide_viewport": self.hide_viewport, "hide_render": self.hide_render}

    def restore(self) -> None:
        """Hide or show the object as it was."""
        self.source.hide_viewport, self.source.hide_render = self.hide_viewport, self.hide_render


def source_states(stored: Mapping[str, Any]) -> list[SourceState]:
    """Return the objects of a custom property, without those deleted since."""
    found = [SourceState.read(entry) for entry in stored.values()]
    return [entry for entry in found if entry is not None]
