"""Objects that a build hides, and how they were hidden before."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import bpy

SOLID: Final = "TEXTURED"
"""How Blender draws an object if nobody asks for another way."""


@dataclass(frozen=True, slots=True, eq=False)
class SourceState:
    """An object that a build was made of, and how it was hidden and drawn before.

    Attributes
    ----------
    source : bpy.types.Object
    hide_viewport, hide_render : bool
    display_type : str
    show_in_front : bool
    """

    source: bpy.types.Object
    hide_viewport: bool
    hide_render: bool
    display_type: str = SOLID
    show_in_front: bool = False

    @classmethod
    def of(cls, source: bpy.types.Object) -> SourceState:
        """Return an object as it is hidden and drawn now."""
        return cls(source, source.hide_viewport, source.hide_render, source.display_type, source.show_in_front)

    @classmethod
    def read(cls, stored: Mapping[str, Any]) -> SourceState | None:
        """Return what :meth:`stored` wrote; None where the object is gone or the form is another one."""
        source = stored.get("object")
        if not isinstance(source, bpy.types.Object):
            return None
        hidden = bool(stored.get("hide_viewport")), bool(stored.get("hide_render"))
        # files of earlier versions do not say how it was drawn
        return cls(source, *hidden, stored.get("display_type", SOLID), bool(stored.get("show_in_front")))

    def stored(self) -> dict[str, Any]:
        """Return plain values for a custom property."""
        return {
            "object": self.source,
            "hide_viewport": self.hide_viewport,
            "hide_render": self.hide_render,
            "display_type": self.display_type,
            "show_in_front": self.show_in_front,
        }

    def restore(self) -> None:
        """Hide or show the object as it was, and draw it as before."""
        self.source.hide_viewport, self.source.hide_render = self.hide_viewport, self.hide_render
        self.draw_as_before()

    def draw_as_before(self) -> None:
        """Draw the object as before, if it is shown."""
        self.source.display_type, self.source.show_in_front = self.display_type, self.show_in_front

    def show_as_ghost(self) -> None:
        """Show the object's wires before everything else, in the viewport alone."""
        self.source.hide_viewport, self.source.hide_render = False, True
        self.source.display_type, self.source.show_in_front = "WIRE", True


def source_states(stored: Mapping[str, Any]) -> list[SourceState]:
    """Return the objects of a custom property, without those deleted since."""
    found = [SourceState.read(entry) for entry in stored.values()]
    return [entry for entry in found if entry is not None]
