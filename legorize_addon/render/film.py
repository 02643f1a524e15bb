"""A film of the builds of a scene: how one is put together, and all of them from every side.

A film is a scene of its own, which stays: it can be played, changed, rendered in
Blender, or saved and rendered frame by frame elsewhere.
"""

from __future__ import annotations

import math
import shutil
import tempfile
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import bpy
import numpy as np

from ..core.arrays import Floats
from ..core.errors import BuildError
from ..core.progress import Progress
from ..view import animate, corners_while_building, shown_corners
from .still import AZIMUTH, ELEVATION
from .studio import add_camera, add_ground, add_light, model_corners, new_studio, set_up_render

FILM_KEY: Final = "legorize_film"
NAME: Final = "Legorize Film"

PAUSE: Final = 24
"""Frames for which the finished model is shown before and after it turns: a second at Blender's usual rate."""

DIRECTIONS: Final = 24
"""Sides from which the turning camera has to take in the model: between two of them it sees .9 % less at most."""


@dataclass(frozen=True, slots=True)
class Cut:
    """What a film shows, one after the other.

    Attributes
    ----------
    frames_a_step : int
        Frames of each building step; 0 shows no building.
    frames_a_turn : int
        Frames in which the camera goes round once; 0 lets it stand.
    """

    frames_a_step: int
    frames_a_turn: int


def make_film(
    scene: bpy.types.Scene,
    build: bpy.types.Collection,
    cut: Cut,
    *,
    samples: int = 8,
    resolution: tuple[int, int] = (640, 480),
) -> bpy.types.Scene:
    """Make a film, in place of an earlier one.

    Parameters
    ----------
    scene : bpy.types.Scene
        Scene of the builds.
    build : bpy.types.Collection
        The one that is put together; the others stand beside it.
    cut : Cut
    samples : int, optional
        Light paths a pixel.
    resolution : tuple of two int, optional
        Width and height in pixels.

    Returns
    -------
    bpy.types.Scene
        With camera, light, ground and the range of its frames, from 1.

    Raises
    ------
    BuildError
        There is nothing to show, the build does not know its steps, or Cycles
        is switched off.
    """
    for old in [each for each in bpy.data.scenes if FILM_KEY in each and each != scene]:
        _remove(old)
    last = 1
    if cut.frames_a_step:
        last = animate(scene, build, first=1, frames=cut.frames_a_step).last
    film = new_studio(scene, NAME)
    film[FILM_KEY] = True
    corners = model_corners(film, corners_while_building if cut.frames_a_step else shown_corners)
    azimuth = AZIMUTH["front_right"]
    set_up_render(film, samples, resolution)
    add_light(film, azimuth, ELEVATION)
    add_ground(film, corners)
    camera = add_camera(film, _swept(corners) if cut.frames_a_turn else corners, azimuth, ELEVATION)
    if cut.frames_a_turn:
        begin = last + (PAUSE if cut.frames_a_step else 0)
        last = begin + cut.frames_a_turn
        _turn(film, camera, corners, begin, last)
    film.frame_start, film.frame_end = 1, last + (PAUSE if cut.frames_a_step else -1)
    film.render.filepath = "//frames/"
    film.frame_current = 1
    return film


def render_frames(
    film: bpy.types.Scene,
    folder: Path,
    progress: Progress,
    *,
    around: Callable[[], AbstractContextManager[object]] = nullcontext,
) -> None:
    """Render all frames of a film into a folder, one file each.

    Parameters
    ----------
    film : bpy.types.Scene
        Made by :func:`make_film`.
    folder : pathlib.Path
        It exists; the files are 0001.png and so on.
    progress : Progress
        Told after each frame; it may stop the work.
    around : callable, optional
        Makes what surrounds each render, such as one that keeps its lines off
        the screen; progress is told outside.

    Raises
    ------
    BuildError
        A file cannot be written.
    """
    first, last, path = film.frame_start, film.frame_end, film.render.filepath
    try:
        # a single picture of a scene that no window shows would be of the frame in which it was made
        # and a folder of the session goes even if the process is ended in the middle of a frame
        with tempfile.TemporaryDirectory(dir=bpy.app.tempdir) as place:
            film.render.filepath = str(Path(place) / "frame")
            progress("film", 0.0)
            for number in range(first, last + 1):
                film.frame_start = film.frame_end = number
                with around():
                    bpy.ops.render.render("EXEC_DEFAULT", animation=True, scene=film.name)
                shutil.move(Path(place) / f"frame{number:04d}.png", folder / f"{number:04d}.png")
                progress("film", (number + 1 - first) / (last + 1 - first))
    except (OSError, RuntimeError) as error:
        raise BuildError(f"The film cannot be written ({str(error).strip()}): choose another folder.") from error
    finally:
        film.frame_start, film.frame_end, film.render.filepath = first, last, path


def _swept(corners: Floats) -> Floats:
    """Return corners turned about their middle, as the camera sees them from all sides, (k, 3)."""
    middle = _middle(corners)
    away = corners[:, :2] - middle[:2]
    angles = np.arange(DIRECTIONS) * 2 * math.pi / DIRECTIONS
    reach = float(np.hypot(*away.T).max()) / math.cos(math.pi / DIRECTIONS)
    round_about = middle[:2] + reach * np.column_stack([np.cos(angles), np.sin(angles)])
    low, high = corners[:, 2].min(), corners[:, 2].max()
    return np.concatenate([np.column_stack([round_about, np.full(DIRECTIONS, z)]) for z in (low, high)])


def _middle(corners: Floats) -> Floats:
    middle: Floats = (corners.min(axis=0) + corners.max(axis=0)) / 2
    return middle


def _turn(film: bpy.types.Scene, camera: bpy.types.Object, corners: Floats, begin: int, end: int) -> None:
    """Let the camera and the suns go round once, in even steps: the light falls on the model as if that one turned."""
    axis = bpy.data.objects.new("Legorize Turntable", None)
    axis.location = _middle(corners)
    film.collection.objects.link(axis)
    film.view_layers[0].update()
    for thing in [camera, *(each for each in film.collection.objects if each.type == "LIGHT")]:
        thing.parent = axis
        thing.matrix_parent_inverse = axis.matrix_world.inverted()
    for frame, angle in ((begin, 0.0), (end, 2 * math.pi)):
        axis.rotation_euler.z = angle
        axis.keyframe_insert("rotation_euler", index=2, frame=frame)
    for point in _curve(axis).keyframe_points:
        point.interpolation = "LINEAR"


def _curve(thing: bpy.types.Object) -> bpy.types.FCurve:
    """Return the only curve of an object's action."""
    action = thing.animation_data.action
    if hasattr(action, "fcurves"):
        return action.fcurves[0]
    # Blender 5 keeps curves in channel bags
    return action.layers[0].strips[0].channelbags[0].fcurves[0]


def _remove(film: bpy.types.Scene) -> None:
    """Remove a film and what only it had."""
    if len(bpy.data.scenes) == 1:
        raise BuildError("The film is the only scene of the file: add another one.")
    own, world = list(film.collection.objects), film.world
    bpy.data.scenes.remove(film)
    data = [thing.data for thing in own if thing.data is not None]
    actions = [each.animation_data.action for each in own if each.animation_data and each.animation_data.action]
    materials = [slot.material for each in own for slot in each.material_slots if slot.material]
    bpy.data.batch_remove([*own, *data, *actions, *materials, *([world] if world else [])])
