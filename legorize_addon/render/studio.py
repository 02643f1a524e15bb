"""The place where pictures are taken: a scene of its own, with light, ground and camera.

It shares the builds' collections with the user's scene, whose camera, lights and
render settings never change.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Final

import bpy
import numpy as np
from mathutils import Euler, Vector

from ..core.arrays import Floats
from ..core.errors import BuildError
from ..scene import builds, damage, world_from_mm

FOCAL_LENGTH: Final = 85.0
MARGIN: Final = 0.08
"""Share of the camera's distance that is left free around the model."""

SKY: Final = (0.85, 0.92, 1.0)
SKY_STRENGTH: Final = 0.4
GROUND: Final = (0.62, 0.62, 0.62)
GROUND_REACH: Final = 400.0
"""Half the side of the ground, in diagonals of the model: the horizon stays out of the picture."""

# direction from which it shines (azimuth from the camera, elevation), strength, size in degrees; the last one stands
# behind the model, large and low: tops reflect it, as plastic in a photograph, and seams between them are seen
SUNS: Final = ((-50.0, 50.0, 1.5, 10.0), (75.0, 25.0, 0.3, 60.0), (165.0, 30.0, 0.6, 70.0))


@contextmanager
def studio_of(scene: bpy.types.Scene) -> Iterator[bpy.types.Scene]:
    """Yield a scene that shows the builds, and remove it with all that was added to it."""
    before = {
        kind: set(getattr(bpy.data, kind)) for kind in ("worlds", "objects", "meshes", "lights", "cameras", "materials")
    }
    studio = new_studio(scene, "Legorize Still")
    try:
        yield studio
    finally:
        bpy.data.scenes.remove(studio)
        for kind, kept in before.items():
            bpy.data.batch_remove([thing for thing in getattr(bpy.data, kind) if thing not in kept])


def new_studio(scene: bpy.types.Scene, name: str) -> bpy.types.Scene:
    """Return a new scene that shows the builds of another one as they are in its frame."""
    studio = bpy.data.scenes.new(name)
    for build in (build for build in builds(scene) if damage(build) is None):
        studio.collection.children.link(build)
    studio.frame_current = scene.frame_current
    studio.view_layers[0].update()
    return studio


def model_corners(studio: bpy.types.Scene, corners_of: Callable[[bpy.types.Collection], Floats]) -> Floats:
    """Return the corners of all bricks in world units, shape (n, 3)."""
    found = []
    for build in studio.collection.children:
        matrix = np.array(world_from_mm(build))
        found.append(corners_of(build) @ matrix[:3, :3].T + matrix[:3, 3])
    if not found:
        raise BuildError("The scene has no brick model to render: legorize an object first.")
    return np.concatenate(found)


def set_up_render(studio: bpy.types.Scene, samples: int, resolution: tuple[int, int]) -> None:
    """Set Cycles up for small clean pictures.

    Raises
    ------
    BuildError
        Cycles is switched off.
    """
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


def add_light(studio: bpy.types.Scene, azimuth: float, elevation: float) -> None:
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
        sun.rotation_euler = look(azimuth + turn, math.copysign(height, elevation))
        studio.collection.objects.link(sun)


def add_ground(studio: bpy.types.Scene, corners: Floats) -> None:
    """Add a ground below the lowest of some corners, as far as the picture reaches."""
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


def add_camera(studio: bpy.types.Scene, corners: Floats, azimuth: float, elevation: float) -> bpy.types.Object:
    """Add a camera that takes in all corners, from a direction in degrees, and return it."""
    lens = bpy.data.cameras.new("Legorize Camera")
    lens.lens = FOCAL_LENGTH
    camera = bpy.data.objects.new("Legorize Camera", lens)
    camera.rotation_euler = look(azimuth, elevation)
    studio.collection.objects.link(camera)
    studio.camera = camera
    studio.view_layers[0].update()
    place, _ = camera.camera_fit_coords(studio.view_layers[0].depsgraph, corners.ravel().tolist())
    target = Vector(corners.mean(axis=0))
    away = place - target
    camera.location = target + away * (1 + MARGIN)
    lens.clip_start, lens.clip_end = away.length / 100, away.length * 10 * GROUND_REACH
    return camera


def look(azimuth: float, elevation: float) -> Euler:
    """Return the rotation of something that looks along -z and stands in a direction given in degrees."""
    return Euler((math.radians(90.0 - elevation), 0.0, math.radians(azimuth)))


def _set_denoiser(studio: bpy.types.Scene) -> bool:
    """Choose the fast OpenImageDenoise; return False where Blender was built without it, as Debian's."""
    try:
        studio.cycles.denoiser = "OPENIMAGEDENOISE"
    except TypeError:
        return False
    studio.cycles.denoising_quality = "FAST"
    studio.cycles.denoising_prefilter = "FAST"
    return True
