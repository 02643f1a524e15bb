"""A model becomes an asset that is found by its tags, and stays the model that it is."""

from __future__ import annotations

from pathlib import Path

import bpy
import pytest

from legorize_addon.scene.builds import builds
from legorize_addon.scene.collections import read_bricks
from tests.blender.bricks import show, table

pytestmark = pytest.mark.usefixtures("addon")


def test_another_file_finds_it(tmp_path: Path) -> None:
    """Saved, the collection is an asset there, with what it is as its description, and can be appended."""
    show(table([(0, 0, 0, 0, 0, 4), (0, 0, 0, 3, 0, 4)]), name="tower")
    assert bpy.ops.legorize.mark_asset() == {"FINISHED"}
    assert bpy.ops.legorize.mark_asset() == {"FINISHED"}
    path = str(tmp_path / "assets.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(path, link=False, assets_only=True) as (there, wanted):
        assert there.collections == ["Legorize tower"]
        wanted.collections = there.collections
    [found] = wanted.collections
    assert sorted(tag.name for tag in found.asset_data.tags) == ["bricks", "legorize", "tower"]
    assert found.asset_data.description.startswith("2 bricks, ")
    bpy.context.scene.collection.children.link(found)
    assert builds(bpy.context.scene) == [found]
    assert len(read_bricks(found)) == 2
