"""The steps of the method in the scene."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from legorize_addon.core.method.lines import trajectory_lines
from legorize_addon.core.method.unit_models import hollowed_model, initial_model
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.scene.builds import builds, layers_of, line_objects
from legorize_addon.scene.collections import clear_build, read_bricks
from legorize_addon.scene.placing import world_from_mm
from legorize_addon.view.method import MethodView, show_method, show_trajectories, trajectories_shown
from legorize_addon.view.visibility import roles_shown, show_layers, shown_corners
from tests.core.method.drafts import SIDES, draft

CATALOGUE = load_catalogue()


def shown(step, lines="sides", **more):
    """Show a step of the tubes, one Blender unit a mm."""
    return show_method(bpy.context.scene, draft(), "Tubes", view=MethodView(step, lines, **more), mm_per_unit=1.0)


def place(build):
    """Return how far to the right of the model's own place a build stands, in mm."""
    bpy.context.view_layer.update()
    return world_from_mm(build).translation.x - float(draft().grid.origin[0])


@pytest.mark.parametrize("lines", ["sides", "colours"])
def test_trajectories_are_curves_in_their_layers(lines):
    """A curve a layer with every line, in the right places and paints; bricks are hidden at first."""
    build = shown("trajectories", lines, beside=False)
    wanted = trajectory_lines(draft(), CATALOGUE, shown=lines)
    curves = line_objects(build)
    assert len(curves) == len(layers_of(build)) == 5
    splines = [spline for curve in curves for spline in curve.data.splines]
    assert sorted(len(spline.points) for spline in splines) == sorted(wanted.count.tolist())
    assert all(spline.use_cyclic_u == wanted.closed for spline in splines)
    points = np.array([point.co[:3] for spline in splines for point in spline.points])
    np.testing.assert_allclose(np.sort(points, axis=0), np.sort(wanted.points, axis=0), atol=1e-4)
    names = {material.name for curve in curves for material in curve.data.materials}
    assert names == {f"Trajectory {name}" for name, _ in wanted.paints}
    assert not any(roles_shown(build).values())
    assert trajectories_shown(build)
    # lines have a thickness
    assert np.ptp(shown_corners(build), axis=0)[0] == pytest.approx(SIDES[0], abs=2)


def test_trajectories_lie_on_the_surface():
    """In the place of the model, a Blender unit a mm, they are as wide and as deep as the mesh, at their heights."""
    build = shown("trajectories", beside=False)
    bpy.context.view_layer.update()
    points = np.array(
        [
            curve.matrix_world @ point.co.to_3d()
            for curve in line_objects(build)
            for spline in curve.data.splines
            for point in spline.points
        ]
    )
    corners = draft().mesh.vertices / draft().scale
    for low_or_high in (np.min, np.max):
        np.testing.assert_allclose(low_or_high(points, axis=0)[:2], low_or_high(corners, axis=0)[:2], atol=0.5)
    heights = np.unique(np.round(points[:, 2] * draft().scale, 3))
    np.testing.assert_allclose(heights, draft().cut.slices.heights, atol=1e-2)


def test_layers_hide_trajectories_too():
    """One layer alone shows its own curve and no other."""
    build = shown("trajectories")
    show_layers(bpy.context.scene, build, 2, single=True)
    visible = [layer for layer in layers_of(build) if not layer.hide_render]
    assert [thing for layer in visible for thing in layer.objects if thing in line_objects(build)]
    assert len(visible) == 1
    heights = shown_corners(build)[:, 2]
    assert 9.6 - 2 < heights.min() < heights.max() < 2 * 9.6 + 2


def test_unit_bricks_and_hollowing_are_models_of_their_own():
    """Each has its bricks, takes the place of the step shown before, stands beside it, and goes without trace."""
    before = len(bpy.data.curves), len(bpy.data.materials), len(bpy.data.meshes)
    build = shown("unit-bricks")
    assert len(read_bricks(build)) == len(initial_model(draft().grid, CATALOGUE))
    assert not trajectories_shown(build)
    show_trajectories(build, visible=True)
    assert trajectories_shown(build)
    away = place(build)
    assert away == pytest.approx((draft().grid.colour.shape[3] + 4) * 8, rel=1e-5)
    build = shown("hollowing")
    assert builds(bpy.context.scene) == [build]
    assert len(read_bricks(build)) == len(hollowed_model(draft().hollow, CATALOGUE))
    assert place(build) == pytest.approx(away)
    clear_build(bpy.context.scene, build)
    assert (len(bpy.data.curves), len(bpy.data.materials), len(bpy.data.meshes)) == before
