"""What a build keeps in the file: one typed reader and writer of the custom property on its collection.

The property's form is versioned. The state of version 0.1.0 names no version
and is read as version 1; later fields that it lacks are as in a new build.
A property of any other form is not ours: it is not a build, and nothing that it
names is ever touched.
"""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any, Final

import bpy

from ..core.model import Role
from .section import Section
from .source_state import SourceState, source_states

BUILD_KEY: Final = "legorize"
VERSION: Final = 2
"""Raised whenever older versions could no longer read what this one writes."""

FORM: Final[Mapping[str, type]] = {
    "mm_per_unit": float,
    "scale": float,
    "layers": int,
    "top_layer": int,
    "part_numbers": list,
    "extent": dict,
    "section": dict,
    "roles": dict,
    "sources": dict,
    "summary": dict,
}
"""Fields that every version has, and what each is as a plain value: by them a build is known."""

POINTERS: Final = ("root", "plane", "parts")
"""Fields that every version has and that are empty where what they point to was deleted."""


class BuildState:
    """The state of one build, read from and written to the file at every access.

    Parameters
    ----------
    build : bpy.types.Collection
        For which :func:`is_build` holds.
    """

    __slots__ = ("_group", "owner")

    def __init__(self, build: bpy.types.Collection) -> None:
        self.owner = build
        self._group = build[BUILD_KEY]

    @property
    def version(self) -> int:
        """Version of the form; 1 for what version 0.1.0 wrote."""
        return int(self._group.get("version", 1))

    @property
    def root(self) -> bpy.types.Object | None:
        """Parent of all that the build shows, whose coordinates are in mm from its middle."""
        return self._pointer("root", bpy.types.Object)

    @property
    def plane(self) -> bpy.types.Object | None:
        """Empty beyond which bricks are hidden."""
        return self._pointer("plane", bpy.types.Object)

    @property
    def parts(self) -> bpy.types.Collection | None:
        """Collection of the objects that are instanced; copies of the build share it."""
        return self._pointer("parts", bpy.types.Collection)

    @parts.setter
    def parts(self, parts: bpy.types.Collection) -> None:
        """Keep the collection of the parts."""
        self._group["parts"] = parts

    @property
    def heat_parts(self) -> bpy.types.Collection | None:
        """Collection of the parts in the colours of the heat map; None while it is off."""
        return self._pointer("heat", bpy.types.Collection)

    @heat_parts.setter
    def heat_parts(self, parts: bpy.types.Collection | None) -> None:
        """Keep the collection of the parts in the colours of the heat map; None says that it is off."""
        if parts is not None:
            self._group["heat"] = parts
        elif "heat" in self._group:
            del self._group["heat"]

    @property
    def origin(self) -> tuple[float, float, float]:
        """Corner of the grid in model mm."""
        x, y, z = self._group["origin"]
        return float(x), float(y), float(z)

    @property
    def middle(self) -> tuple[float, float, float]:
        """Where the root is in the model, in mm from the corner of the grid; at this corner in earlier versions."""
        x, y, z = self._group.get("middle", (0.0, 0.0, 0.0))
        return float(x), float(y), float(z)

    @property
    def scale(self) -> float:
        """Model mm per world mm."""
        return float(self._group["scale"])

    @property
    def mm_per_unit(self) -> float:
        """World mm per Blender unit, as it was built."""
        return float(self._group["mm_per_unit"])

    @property
    def edits(self) -> tuple[str, str]:
        """Changes by hand as JSON, and the bricks without them, see :mod:`.kept_edits`; empty without any."""
        return str(self._group.get("edits", "")), str(self._group.get("unedited", ""))

    @edits.setter
    def edits(self, texts: tuple[str, str]) -> None:
        """Keep changes by hand, and the bricks without them."""
        self._group["edits"], self._group["unedited"] = texts

    @property
    def picked(self) -> list[int]:
        """Rows of the bricks that are picked to be changed."""
        return [int(row) for row in self._group.get("picked", ())]

    @picked.setter
    def picked(self, rows: Sequence[int]) -> None:
        """Keep which bricks are picked."""
        self._group["picked"] = [int(row) for row in rows]

    @property
    def unit_per_mm(self) -> float:
        """Blender units per model mm."""
        return 1.0 / (float(self._group["scale"]) * float(self._group["mm_per_unit"]))

    @property
    def part_numbers(self) -> list[str]:
        """Numbers of the parts that the rows of the bricks' points count in."""
        return list(self._group["part_numbers"])

    @property
    def layers(self) -> int:
        """Number of brick layers, empty ones included."""
        return int(self._group["layers"])

    @property
    def top_layer(self) -> int:
        """Number of layers shown, from the lowest."""
        return int(self._group["top_layer"])

    @top_layer.setter
    def top_layer(self, top: int) -> None:
        """Keep the number of layers shown, from the lowest."""
        self._group["top_layer"] = top

    @property
    def single_layer(self) -> bool:
        """Whether only the highest of these layers is shown."""
        return bool(self._group.get("single_layer", False))

    @single_layer.setter
    def single_layer(self, single: bool) -> None:
        """Keep whether only the highest of these layers is shown."""
        self._group["single_layer"] = single

    @property
    def extent(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Lowest and highest corner of the model in mm."""
        extent = self._group["extent"]
        return tuple(map(float, extent["low"])), tuple(map(float, extent["high"]))

    @property
    def section(self) -> Section:
        """The cut through the build."""
        stored = self._group["section"]
        return Section(axis=stored["axis"], at=stored["at"], flip=bool(stored["flip"]))

    @section.setter
    def section(self, section: Section) -> None:
        """Keep the cut through the build."""
        self._group["section"] = asdict(section)

    @property
    def roles(self) -> dict[Role, bool]:
        """Roles that occur, in their order, and whether each is shown."""
        stored = self._group["roles"]
        return {role: bool(stored[role.name]) for role in Role if role.name in stored}

    def show_role(self, role: Role, *, visible: bool) -> None:
        """Keep whether a role is shown."""
        self._group["roles"][role.name] = visible

    @property
    def sources(self) -> list[SourceState]:
        """Objects that the build was made of, without those deleted since."""
        return source_states(self._group["sources"])

    @property
    def holders(self) -> list[SourceState]:
        """Armatures and empties that hold them and nothing else, without those deleted since; none in old builds."""
        return source_states(self._group.get("holders", {}))

    @property
    def hidden(self) -> list[SourceState]:
        """All objects that the build hides."""
        return [*self.sources, *self.holders]

    @property
    def settings(self) -> dict[str, Any]:
        """Names and values of the settings that the build was made with; empty where they are not known."""
        return self._plain("settings")

    def keep_settings(self, settings: Mapping[str, Any]) -> None:
        """Keep the settings that the build was made with."""
        self._group["settings"] = dict(settings)

    @property
    def notes(self) -> list[str]:
        """Remarks to show beside the result."""
        return list(self._group.get("notes", ()))

    @property
    def objects(self) -> int:
        """Objects whose points are the bricks, as they were made; 0 where an earlier version did not say."""
        return int(self._group.get("objects", 0))

    @property
    def summary(self) -> dict[str, Any]:
        """Figures of the finished model, see :func:`~legorize_addon.scene.figures.summary`."""
        return self._plain("summary")

    @property
    def check(self) -> dict[str, Any]:
        """Whether it stands, see :func:`~legorize_addon.scene.verdict.check_of`; empty where nobody knows."""
        return self._plain("check")

    @property
    def building(self) -> dict[str, Any]:
        """Figures of the building, see :func:`~legorize_addon.scene.figures.building_figures`; empty if unknown."""
        return self._plain("building")

    @property
    def steps(self) -> dict[str, Any]:
        """The building steps, see :func:`~legorize_addon.scene.kept_steps.stored_steps`; empty if unknown."""
        return self._plain("steps")

    @property
    def texts(self) -> dict[str, str]:
        """Contents of files that were kept, by name; empty where an earlier version built it."""
        packed = self._group.get("texts")
        return dict(json.loads(zlib.decompress(base64.b85decode(packed)))) if packed else {}

    def keep_texts(self, texts: Mapping[str, str]) -> None:
        """Keep the contents of files, by name: packed, since tables of a large model have some hundred kilobytes."""
        packed = zlib.compress(json.dumps(dict(texts)).encode("ascii"))
        self._group["texts"] = base64.b85encode(packed).decode("ascii")

    def add_building(self, **figures: int | float | str) -> None:
        """Keep more figures of the building."""
        for name, value in figures.items():
            self._group["building"][name] = value

    @property
    def exploded(self) -> float:
        """How far each piece is lifted off the one below it, as a share of the model's height."""
        return float(self._group.get("exploded", 0.0))

    @exploded.setter
    def exploded(self, share: float) -> None:
        """Keep how far each piece is lifted off the one below it, as a share of the model's height."""
        self._group["exploded"] = share

    @property
    def steps_done(self) -> int:
        """Building steps after which the build is shown; 0 shows it whole."""
        return int(self._group.get("steps_done", 0))

    @steps_done.setter
    def steps_done(self, steps: int) -> None:
        """Keep the number of building steps that are shown; 0 shows the whole build."""
        self._group["steps_done"] = steps

    @property
    def supports_shown(self) -> bool:
        """Whether supports are to be shown again when the steps are left."""
        return bool(self._group.get("supports_shown", False))

    @supports_shown.setter
    def supports_shown(self, visible: bool) -> None:
        """Keep whether supports are to be shown again when the steps are left."""
        self._group["supports_shown"] = visible

    def _pointer(self, name: str, kind: type[bpy.types.ID]) -> Any:
        found = self._group.get(name)
        return found if isinstance(found, kind) else None

    def _plain(self, name: str) -> dict[str, Any]:
        found = self._group.get(name)
        return {} if found is None else dict(found.to_dict())


def state_of(build: bpy.types.Collection) -> BuildState:
    """Return the state of a build."""
    return BuildState(build)


def is_build(collection: bpy.types.Collection) -> bool:
    """Return whether a collection is a build, not one of somebody else with a property of the same name."""
    group = collection.get(BUILD_KEY)
    if not hasattr(group, "to_dict"):
        return False
    stored = group.to_dict()
    fits = all(isinstance(stored.get(name), kind) for name, kind in FORM.items())
    return fits and all(name in stored for name in POINTERS) and isinstance(stored.get("version", 1), int)


def write_state(
    build: bpy.types.Collection,
    *,
    origin: Sequence[float],
    sources: Sequence[SourceState],
    holders: Sequence[SourceState] = (),
    section: Section,
    roles: Sequence[Role],
    **fields: Any,
) -> BuildState:
    """Give a new build its state.

    Parameters
    ----------
    build : bpy.types.Collection
        The new collection.
    origin : sequence of three float
        Corner of the grid in model mm.
    sources, holders : sequence of SourceState
        What it was made of, and what held that.
    section : Section
        The cut.
    roles : sequence of Role
        Roles that occur, all shown.
    **fields
        The other fields, as :class:`BuildState` names them: what Blender keeps
        in a custom property.

    Returns
    -------
    BuildState
    """
    build[BUILD_KEY] = {
        "version": VERSION,
        "origin": [float(value) for value in origin],
        "sources": {str(i): source.stored() for i, source in enumerate(sources)},
        "holders": {str(i): holder.stored() for i, holder in enumerate(holders)},
        "section": asdict(section),
        "roles": {role.name: True for role in roles},
        **fields,
    }
    return BuildState(build)
