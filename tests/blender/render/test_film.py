"""Films: a scene with a camera that sees the model in every frame, and frames as files."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector
from PIL import Image

from legorize_addon.core.errors import BuildError, Cancelled
from legorize_addon.render.film import FILM_KEY, PAUSE, Cut, make_film, render_frames
from legorize_addon.scene.builds import builds
from legorize_addon.scene.state import state_of
from legorize_addon.view.animation import Animation, animation_of
from legorize_addon.view.steps import n_steps
from legorize_addon.view.visibility import shown_corners
from tests.blender.bricks import content, show, table
from tests.blender.view.test_steps import ONE, RED, show_storeys

SMALL = {"samples": 1, "resolution": (64, 48)}


def model() -> bpy.types.Collection:
    """Show one lonely brick far from the origin."""
    return show(table([(ONE, 9, 2, 0, 0, RED, 0, 0)]))


def test_the_camera_sees_the_model_in_every_frame() -> None:
    """While it goes round, no corner leaves the picture; it comes back to where it began, and stands still between."""
    build = show_storeys(0)[0]
    film = make_film(bpy.context.scene, build, Cut(0, 40), **SMALL)
    assert (film.frame_start, film.frame_end) == (1, 40)
    places = []
    for frame in range(1, 42):
        film.frame_set(frame)
        seen = [
            world_to_camera_view(film, film.camera, Vector(corner)) for corner in shown_corners(build) * _scale(build)
        ]
        assert np.min([place[:2] for place in seen]) >= 0
        assert np.max([place[:2] for place in seen]) <= 1
        places.append(np.array(film.camera.matrix_world.translation))
    ways = np.linalg.norm(np.diff(places, axis=0), axis=1)
    np.testing.assert_allclose(ways, ways[0], rtol=1e-3)
    np.testing.assert_allclose(places[0], places[-1], atol=1e-4)


def _scale(build: bpy.types.Collection) -> float:
    """Return world units a mm."""
    root = state_of(build).root
    return float(root.matrix_world.median_scale)


def test_building_and_turning_follow_each_other() -> None:
    """The steps come first, then a pause, a turn and a pause; the user's scene is as it was."""
    build, _, _ = show_storeys(0, 1)
    scene = bpy.context.scene
    before = scene.camera, scene.frame_end, scene.render.engine, list(scene.objects)
    film = make_film(scene, build, Cut(10, 30), **SMALL)
    made = animation_of(build)
    assert made == Animation(1, 10, n_steps(build))
    assert film.frame_end == made.last + PAUSE + 30 + PAUSE
    assert (scene.camera, scene.frame_end, scene.render.engine, list(scene.objects)) == before
    assert list(film.collection.children) == builds(scene)


def test_a_second_film_takes_the_place_of_the_first() -> None:
    """Nothing of the first one is left."""
    build = show_storeys(0)[0]
    make_film(bpy.context.scene, build, Cut(0, 10), **SMALL)
    once = content()
    make_film(bpy.context.scene, build, Cut(0, 10), **SMALL)
    assert content() == once
    assert sum(FILM_KEY in scene for scene in bpy.data.scenes) == 1


def test_each_frame_is_a_file(tmp_path: Path) -> None:
    """They are numbered, more of the model is to be seen from one to the next, and progress is told."""
    film = make_film(bpy.context.scene, show_storeys(0)[0], Cut(2, 0), samples=1, resolution=(64, 48))
    film.frame_start, film.frame_end = 2, 4
    told: list[float] = []
    render_frames(film, tmp_path, lambda stage, share: told.append(share))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["0002.png", "0003.png", "0004.png"]
    assert told == pytest.approx([0, 1 / 3, 2 / 3, 1])
    assert (film.frame_start, film.frame_end, film.render.filepath) == (2, 4, "//frames/")
    red = [_red(tmp_path / f"{number:04d}.png") for number in (2, 3, 4)]
    assert red[0] < red[2]


def _red(path: Path) -> float:
    """Return the share of the pixels that are plainly red."""
    with Image.open(path) as image:
        pixels = np.asarray(image.convert("RGB")).astype(float)
    return float((pixels[..., 0] > 1.5 * pixels[..., 1]).mean())


def test_a_stop_ends_it(tmp_path: Path) -> None:
    """The film is as it was."""
    film = make_film(bpy.context.scene, model(), Cut(0, 3), **SMALL)

    def stop(stage: str, share: float) -> None:
        if share > 0.5:
            raise Cancelled

    with pytest.raises(Cancelled):
        render_frames(film, tmp_path, stop)
    assert (film.frame_start, film.frame_end) == (1, 3)


def test_a_build_without_steps_can_turn_but_not_be_built() -> None:
    """One sentence."""
    build = model()
    assert make_film(bpy.context.scene, build, Cut(0, 5), **SMALL).frame_end == 5
    with pytest.raises(BuildError, match="no building steps"):
        make_film(bpy.context.scene, build, Cut(5, 0), **SMALL)
