"""A still picture of the builds of a scene, by Cycles on the processor.

The picture is taken in a scene of its own that shares the builds' collections
with the user's scene and is removed afterwards, so the user's camera, lights
and render settings never change.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Final, Literal

import bpy
import numpy as np
from mathutils import Euler, Vector

from ..core.arrays import Floats
from ..core.errors import BuildError
from ..core.units import PLATE
from ..scene import builds, damage, hidden_side, state_of
from ..view import corners_while_building, shown_corners
from .outlines import outlined

View = Literal["front_left", "front_right", "back_left", "back_right", "below", "section"]

AZIMUTH: Final[dict[View, float]] = {
    "front_left": -35.0,
    "front_right": 35.0,
    "back_left": -145.0,
    "back_right": 145.0,
    "below": 35.0,
}
"""Direction in which the camera stands, in degrees from -y counter-clockwise as seen from above."""

ELEVATION: Final = 24.0
BESIDE: Final = 28.0
"""How far beside the middle of an upright cut the camera stands, in degrees."""

ABOVE: Final = 55.0
"""Elevation from which a level cut is seen, and undersides from as far below, in degrees."""

FOCAL_LENGTH: Final = 85.0
MARGIN: Final = 0.08
"""Share of the camera's distance that is left free around the model."""

LINE_PIXELS: Final = 2.75
LINE_PLATES: Final = 0.35
"""Reach of outlines from the edge, where they fade: in pixels, and in heights of a plate at most."""

SKY: Final = (0.85, 0.92, 1.0)
SKY_STRENGTH: Final = 0.4
GROUND: Final = (0.62, 0.62, 0.62)
GROUND_REACH: Final = 400.0
"""Half the side of the ground, in diagonals of the model: the horizon stays out of the picture."""

# direction from which it shines (azimuth from the camera, elevation), strength, size in degrees
SUNS: Final = ((-50.0, 50.0, 1.9, 10.0), (75.0, 25.0, 0.3, 60.0))


def render_still(
    scene: bpy.types.Scene,
    path: Path,
    *,
    samples: int = 24,
    resolution: tuple[int, int] = (960, 720),
    view: View = "front_right",
    outlines: bool = False,
    whole_building: bool = False,
) -> None:
    """Write a picture of a scene's builds, from a little above, on a pale ground.

    Parameters
    ----------
    scene : bpy.types.Scene
        Its builds are shown as they are, with hidden layers left out.
    path : pathlib.Path
        PNG file to write, in a folder that exists.
    samples : int, optional
        Light paths a pixel.
    resolution : tuple of two int, optional
        Width and height in pixels.
    view : str, optional
        Corner from which the model is seen; "below" looks up at it, with no
        ground; "section" looks onto the cut through the first build that is
        cut open, else as "front_right".
    outlines : bool, optional
        Whether dark lines tell the bricks apart.
    whole_building : bool, optional
        Whether the camera takes in all places where bricks are in any building
        step, so that pictures of several steps match.

    Raises
    ------
    BuildError
        Nothing is to be seen, Cycles is switched off, or the file cannot be written there.
    """
    from ..core.files import replacing

    with replacing(path, "picture") as partial, _studio(scene) as studio:
        corners = _corners(studio, corners_while_building if whole_building else shown_corners)
        azimuth, elevation = _place(studio, view)
        _set_up_render(studio, samples, resolution)
        _add_light(studio, azimuth, elevation)
        if elevation > 0:
            _add_ground(studio, corners)
        _add_camera(studio, corners, azimuth, elevation)
        lines = outlined(_materials(studio), _line_width(studio, corners)) if outlines else nullcontext()
        with lines:
            bpy.ops.render.render("EXEC_DEFAULT", scene=studio.name)
        _save_render(studio, partial)


@contextmanager
def _studio(scene: bpy.types.Scene) -> Iterator[bpy.types.Scene]:
    """Yield a scene that shows the builds, and remove it with all that was added to it."""
    before = {
        kind: set(getattr(bpy.data, kind)) for kind in ("worlds", "objects", "meshes", "lights", "cameras", "materials")
    }
    studio = bpy.data.scenes.new("Legorize Still")
    try:
        for build in (build for build in builds(scene) if damage(build) is None):
            studio.collection.children.link(build)
        studio.view_layers[0].update()
        yield studio
    finally:
        bpy.data.scenes.remove(studio)
        for kind, kept in before.items():
            bpy.data.batch_remove([thing for thing in getattr(bpy.data, kind) if thing not in kept])


def _corners(studio: bpy.types.Scene, corners_of: Callable[[bpy.types.Collection], Floats]) -> Floats:
    """Return the corners of all bricks in world units, shape (n, 3)."""
    found = []
    for build in studio.collection.children:
        matrix = np.array(state_of(build).root.matrix_world)
        found.append(corners_of(build) @ matrix[:3, :3].T + matrix[:3, 3])
    if not found:
        raise BuildError("The scene has no brick model to render: legorize an object first.")
    return np.concatenate(found)


def _place(studio: bpy.types.Scene, view: View) -> tuple[float, float]:
    """Return the azimuth and elevation of the camera in degrees."""
    if view != "section":
        return AZIMUTH[view], -ABOVE if view == "below" else ELEVATION
    sides = [hidden_side(state_of(build).plane) for build in studio.collection.children]
    side = next((side for side in sides if side is not None), None)
    if side is None:
        return AZIMUTH["front_right"], ELEVATION
    x, y, z = side
    if math.hypot(x, y) < abs(z):
        # what is open from below only cannot be looked into, for the ground
        return AZIMUTH["front_right"], ABOVE if z > 0 else ELEVATION
    straight = math.degrees(math.atan2(x, -y))
    return min(straight - BESIDE, straight + BESIDE, key=abs), ELEVATION


def _set_up_render(studio: bpy.types.Scene, samples: int, resolution: tuple[int, int]) -> None:
    try:
        studio.render.engine = "CYCLES"
    except TypeError as error:
        raise BuildError("Cycles is disabled: enable it in Preferences > Add-ons.") from error
    cycles = studio.cycles
    cycles.device = "CPU"
    cycles.samples = samples
    cycles.max_bounces = 4
    cycles.use_denoising = _set_denoiser(studio)
    studio.view_settings.view_transform = "Standard"
    render = studio.render
    render.resolution_x, render.resolution_y = resolution
    render.resolution_percentage = 100
    render.image_settings.file_format = "PNG"
    render.image_settings.color_mode = "RGB"


def _save_render(studio: bpy.types.Scene, path: Path) -> None:
    """Write what was rendered; the path of a scene's output will not do, as words in braces are templates in it."""
    result = next(image for image in bpy.data.images if image.type == "RENDER_RESULT")
    try:
        result.save_render(str(path), scene=studio)
    except RuntimeError as error:
        raise BuildError(f"The picture cannot be written ({str(error).strip()}): choose another place.") from error


def _set_denoiser(studio: bpy.types.Scene) -> bool:
    """Choose the fast OpenImageDenoise; return False where Blender was built without it, as Debian's."""
    try:
        studio.cycles.denoiser = "OPENIMAGEDENOISE"
    except TypeError:
        return False
    studio.cycles.denoising_quality = "FAST"
    studio.cycles.denoising_prefilter = "FAST"
    return True


def _add_light(studio: bpy.types.Scene, azimuth: float, elevation: float) -> None:
    """Add a sky, and suns that shine from above, or from below onto undersides."""
    world = bpy.data.worlds.new("Legorize Sky")
    if world.node_tree is None:
        world.use_nodes = True
    background = next(node for node in world.node_tree.nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = (*SKY, 1.0)
    background.inputs["Strength"].default_value = SKY_STRENGTH
    studio.world = world
    for turn, height, strength, size in SUNS:
        light = bpy.data.lights.new("Legorize Sun", "SUN")
        light.energy = strength
        light.angle = math.radians(size)
        sun = bpy.data.objects.new("Legorize Sun", light)
        sun.rotation_euler = _look(azimuth + turn, math.copysign(height, elevation))
        studio.collection.objects.link(sun)


def _add_ground(studio: bpy.types.Scene, corners: Floats) -> None:
    low, high = corners.min(axis=0), corners.max(axis=0)
    reach = GROUND_REACH * float(np.linalg.norm(high - low))
    x, y = ((low + high) / 2)[:2]
    mesh = bpy.data.meshes.new("Legorize Ground")
    square = [(x - reach, y - reach), (x + reach, y - reach), (x + reach, y + reach), (x - reach, y + reach)]
    mesh.from_pydata([(*corner, low[2]) for corner in square], [], [(0, 1, 2, 3)])
    material = bpy.data.materials.new("Legorize Ground")
    if material.node_tree is None:
        material.use_nodes = True
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (*GROUND, 1.0)
    shader.inputs["Roughness"].default_value = 1.0
    mesh.materials.append(material)
    studio.collection.objects.link(bpy.data.objects.new("Legorize Ground", mesh))


def _add_camera(studio: bpy.types.Scene, corners: Floats, azimuth: float, elevation: float) -> None:
    lens = bpy.data.cameras.new("Legorize Camera")
    lens.lens = FOCAL_LENGTH
    camera = bpy.data.objects.new("Legorize Camera", lens)
    camera.rotation_euler = _look(azimuth, elevation)
    studio.collection.objects.link(camera)
    studio.camera = camera
    studio.view_layers[0].update()
    place, _ = camera.camera_fit_coords(studio.view_layers[0].depsgraph, corners.ravel().tolist())
    target = Vector(corners.mean(axis=0))
    away = place - target
    camera.location = target + away * (1 + MARGIN)
    lens.clip_start, lens.clip_end = away.length / 100, away.length * 10 * GROUND_REACH


def _materials(studio: bpy.types.Scene) -> list[bpy.types.Material]:
    """Return the materials of all bricks, and of their heat maps."""
    variants = [variant for build in studio.collection.children for variant in state_of(build).parts.all_objects]
    found = {slot.material.name: slot.material for variant in variants for slot in variant.material_slots}
    return [found[name] for name in sorted(found)]


def _line_width(studio: bpy.types.Scene, corners: Floats) -> float:
    """Return the width of outlines in world units: some pixels, less where bricks are small in the picture."""
    camera, render = studio.camera, studio.render
    away = float(np.linalg.norm(corners.mean(axis=0) - np.array(camera.location)))
    pixel = away * camera.data.sensor_width / camera.data.lens / max(render.resolution_x, render.resolution_y)
    plates = [float(state_of(build).root.matrix_world.median_scale) for build in studio.collection.children]
    return min(LINE_PIXELS * pixel, LINE_PLATES * PLATE * min(plates))


def _look(azimuth: float, elevation: float) -> Euler:
    """Return the rotation of something that looks along -z and stands in a direction given in degrees."""
    return Euler((math.radians(90.0 - elevation), 0.0, math.radians(azimuth)))
