"""The icon of the tool is what its script draws, and in the form of Blender's own."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np

from legorize_addon.ui.edit_tool import LEGORIZE_WT_edit
from scripts.draw_icon import FILE, icon


def test_file_is_what_the_script_draws() -> None:
    """Nobody has changed the one without the other, and the tool names it as Blender wants it."""
    assert FILE.read_bytes() == icon()
    assert Path(f"{LEGORIZE_WT_edit.bl_icon}.dat") == FILE


def test_blender_reads_it() -> None:
    """It is taken as Blender's own icons are, fits into their square, and shows a brick with a picked stud."""
    number = bpy.app.icons.new_triangles_from_file(str(FILE))
    assert number > 0
    bpy.app.icons.release(number)
    data = np.frombuffer(FILE.read_bytes()[8:], dtype=np.uint8)
    third = len(data) // 3
    corners, colours = data[:third].reshape(-1, 2), data[third:].reshape(-1, 4)
    assert len(corners) == len(colours)
    assert np.ptp(corners, axis=0).min() > 120
    assert len(np.unique(colours, axis=0)) == 5
