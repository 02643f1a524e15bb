"""The building order at a glance: pictures of some of its steps, side by side in one image."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any, Final

import bpy
import numpy as np
from numpy.typing import NDArray

from ..core.files import replacing
from ..core.progress import Progress, silent
from ..view import animate, animation_of, check_steps, highlight_step, highlighted, n_steps, show_steps, steps_done
from .still import render_still

MARGIN: Final = 4
"""Pixels of white between two pictures."""


def render_contact_sheet(
    scene: bpy.types.Scene,
    build: bpy.types.Collection,
    path: Path,
    *,
    pictures: int,
    progress: Progress = silent,
    around: Callable[[], AbstractContextManager[object]] = nullcontext,
    **look: Any,
) -> None:
    """Write pictures of a build at evenly spaced building steps, row by row; the last one shows the finished model.

    Parameters
    ----------
    scene : bpy.types.Scene
        The build's scene.
    build : bpy.types.Collection
        The build; it is shown as it was before when all pictures are taken.
    path : pathlib.Path
        PNG file to write, in a folder that exists.
    pictures : int
        How many; a build of fewer steps has one for each.
    progress : Progress, optional
        Told after each picture; it may stop the work.
    around : callable, optional
        Makes what surrounds each render, such as one that keeps its lines off
        the screen; progress is told outside.
    **look : Any
        What :func:`.render_still` takes; by default 8 samples and 480 x 360 pixels.

    Raises
    ------
    BuildError
        The build does not know its steps, or the file cannot be written there.
    """
    check_steps(build)
    before, bright, moving = steps_done(build), highlighted(build), animation_of(build)
    with replacing(path, "picture") as partial, tempfile.TemporaryDirectory(dir=bpy.app.tempdir) as folder:
        frame, taken = Path(folder) / "frame.png", []
        try:
            highlight_step(build, visible=False)
            look = {"samples": 8, "resolution": (480, 360), "whole_building": True} | look
            wanted = even_steps(n_steps(build), pictures)
            progress("contact sheet", 0.0)
            for steps in wanted:
                show_steps(build, steps)
                with around():
                    render_still(scene, frame, **look)
                taken.append(_pixels(frame))
                progress("contact sheet", len(taken) / len(wanted))
        finally:
            show_steps(build, before)
            highlight_step(build, visible=bright)
            if moving:
                animate(scene, build, first=moving.first, frames=moving.frames)
        _write(tiled(taken), partial)


def even_steps(n_steps: int, pictures: int) -> list[int]:
    """Return after how many of some steps pictures are taken, the last one after all of them."""
    wanted = min(pictures, n_steps)
    return [math.ceil(n_steps * (i + 1) / wanted) for i in range(wanted)]


def tiled(pictures: Sequence[NDArray[np.float32]]) -> NDArray[np.float32]:
    """Put pictures of one size side by side, row by row from above, on white.

    Parameters
    ----------
    pictures : sequence of (h, w, 4) float32 array
        At least one; row 0 is the lowest, as Blender orders pixels.

    Returns
    -------
    (H, W, 4) float32 array
        In as many columns as rows, or one more.
    """
    height, width = pictures[0].shape[:2]
    columns = math.ceil(math.sqrt(len(pictures)))
    rows = math.ceil(len(pictures) / columns)
    size = rows * (height + MARGIN) - MARGIN, columns * (width + MARGIN) - MARGIN
    sheet = np.ones((*size, 4), dtype=np.float32)
    for i, picture in enumerate(pictures):
        row, column = divmod(i, columns)
        low, left = (rows - 1 - row) * (height + MARGIN), column * (width + MARGIN)
        sheet[low : low + height, left : left + width] = picture
    return sheet


def _pixels(path: Path) -> NDArray[np.float32]:
    image = bpy.data.images.load(str(path))
    width, height = image.size
    pixels = np.empty(width * height * 4, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4)


def _write(pixels: NDArray[np.float32], path: Path) -> None:
    height, width = pixels.shape[:2]
    image = bpy.data.images.new("Legorize Sheet", width, height)
    image.pixels.foreach_set(pixels.ravel())
    image.filepath_raw, image.file_format = str(path), "PNG"
    try:
        image.save()
    finally:
        bpy.data.images.remove(image)
