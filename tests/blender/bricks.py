"""Tables of bricks for tests, and what Blender shows of them."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np
from numpy.typing import NDArray

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks, Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.scene.collections import show_build
from legorize_addon.scene.model import Model, Source
from tests.core.any_bricks import SMALL


def table(rows: Sequence[Sequence[int]]) -> Bricks:
    """Return a table from rows of part, x, y, z, turn, colour, role, piece and step; the last three may be left out."""
    full = np.array([[*row, 0, 0, 0][:9] for row in rows])
    return Bricks(
        part=full[:, 0].astype(np.int16),
        corner=full[:, 1:4].astype(np.int32),
        turn=full[:, 4].astype(np.uint8),
        colour=full[:, 5].astype(np.int16),
        role=full[:, 6].astype(np.uint8),
        piece=full[:, 7].astype(np.int16),
        step=full[:, 8].astype(np.int32),
    )


def random_table(n: int, seed: int = 0) -> Bricks:
    """Return bricks of all kinds anywhere, in no order."""
    rng = np.random.default_rng(seed)
    catalogue = load_catalogue()
    columns = [
        rng.choice(SMALL, n),
        *rng.integers(0, 300, (2, n)),
        rng.integers(0, 90, n),
        rng.integers(0, 4, n),
        rng.choice(catalogue.codes, n),
        rng.integers(0, len(Role), n),
        rng.integers(0, 5, n),
        rng.integers(0, 2**31 - 1, n),
    ]
    return table(np.stack(columns, axis=1))


def assert_same(left: Bricks, right: Bricks) -> None:
    """Fail unless two tables are equal to the type."""
    for name in Bricks.__slots__:
        np.testing.assert_array_equal(getattr(left, name), getattr(right, name), err_msg=name, strict=True)


def show(bricks: Bricks, *sources: bpy.types.Object, **changes) -> bpy.types.Collection:
    """Show bricks in the scene, one Blender unit a mm unless said otherwise."""
    place = {name: changes.pop(name, 1.0) for name in ("scale", "mm_per_unit")}
    place["origin"] = changes.pop("origin", (0.0, 0.0, 0.0))
    known = {name: changes.pop(name, None) for name in ("stability", "steps")}
    source = {name: changes.pop(name) for name in ("name", "settings", "notes") if name in changes}
    model = Model(Assembly(bricks, load_catalogue()), **place, **known)
    return show_build(bpy.context.scene, model, Source(**{"name": "thing", "objects": sources} | source), **changes)


def instances() -> list[tuple[bpy.types.Mesh, str, NDArray[np.float64]]]:
    """Return the mesh, material and matrix of each brick that the viewport evaluates."""
    found = bpy.context.evaluated_depsgraph_get().object_instances
    return [
        (entry.object.data.original, entry.object.active_material.name, np.array(entry.matrix_world))
        for entry in found
        if entry.is_instance
    ]


def content() -> dict[str, list[str]]:
    """Return the names of all data of the file that a build may add to or take from."""
    kinds = ("scenes", "objects", "meshes", "collections", "materials", "node_groups", "worlds", "lights", "cameras")
    return {kind: sorted(thing.name for thing in getattr(bpy.data, kind)) for kind in kinds}
