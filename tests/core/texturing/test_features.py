"""Features: small patterns, edges and thin parts count more; borders, grain and flanks do not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.mesh import WeightField, cell_factors, scale_mesh, surface_hits, weight_at
from legorize_addon.core.texturing import features, with_features
from legorize_addon.core.units import STUD
from tests.core.solids import box, sphere
from tests.core.textured import textured

SIDE = 20
"""Studs."""


def plate(image):
    """Return a plate of 20 x 20 x 4 studs whose sides all show an image from above, by their x and y."""
    mesh = box((0, 0, 0), (SIDE * STUD, SIDE * STUD, 4 * STUD))
    uvs = mesh.vertices[mesh.faces][:, :, :2] / (SIDE * STUD)
    return textured(mesh, image, uvs, clamp=True)


def image_of(dark):
    """Return an image of 10 texels a stud: black where it is dark, else white."""
    return np.where(dark[..., None], 0, 255).astype(np.uint8) * np.ones(3, np.uint8)


def at(mesh, x, y):
    """Return the weight at a point on top of a plate, in studs."""
    assert mesh.features is not None
    return float(mesh.features.at(np.array([[x, y, 4.0]]) * STUD)[0])


Y, X = np.mgrid[0 : 10 * SIDE, 0 : 10 * SIDE] / 10


def test_a_small_pattern_is_a_feature_and_a_border_is_none():
    """An eye of a stud and a half has its full weight, the rim of a half that is black has none, nor has a flank."""
    eye = (np.abs(X - 5) < 0.75) & (np.abs(Y - 5) < 0.75)
    mesh = with_features(plate(image_of(eye | (X > 15))), "colours", 3.0)
    assert at(mesh, 5, 5) > 2
    assert at(mesh, 15, 10) < 0.3
    assert at(mesh, 10, 15) == 0


def test_the_grain_of_a_texture_is_none():
    """Noise of a tenth of a stud is seen as its mean: nothing counts more."""
    noise = np.random.default_rng(0).random(X.shape) < 0.5
    plain = plate(image_of(noise))
    assert (
        with_features(plain, "colours", 3.0) is plain or with_features(plain, "colours", 3.0).features.values.max() < 1
    )


def test_both_sides_of_a_stroke_belong_together():
    """A line of a stud counts, and the more the clearer it is."""
    weights = []
    for grey in (0, 150, 240):
        image = image_of(np.zeros(X.shape, bool))
        image[np.abs(X - 10) < 0.5] = grey
        mesh = with_features(plate(image), "colours", 1.0)
        weights.append(at(mesh, 10, 10) if mesh.features is not None else 0.0)
    assert weights[0] > weights[1] > weights[2] == 0
    assert weights[0] > 0.7


@pytest.mark.parametrize(("size", "least", "most"), [(12.0, 0.0, 0.0), (1.2, 0.2, 1.0)])
def test_what_turns_within_a_stud_is_a_feature(size, least, most):
    """A small ball bends everywhere, a large one nowhere; what bends everywhere has a quarter of the weight."""
    mesh = with_features(sphere(24, size * STUD), "shapes", 1.0)
    if most == 0:
        assert mesh.features is None
        return
    hits = zip(*surface_hits(mesh, mesh.vertices.min(axis=0)), strict=True)
    face, points, _, area = (np.concatenate(each) for each in hits)
    weight = weight_at(mesh, face, points)
    assert least <= np.average(weight, weights=area) <= features._MOST + 0.01
    assert weight.max() <= most


def test_edges_count_and_flats_do_not():
    """At the upper edge of a plate is weight, in its middle none; colours alone do not see it."""
    plain = plate(image_of(np.zeros(X.shape, bool)))
    mesh = with_features(plain, "shapes", 1.0)
    assert at(mesh, 0, 10) > 0.1
    assert at(mesh, 10, 10) == 0
    assert with_features(plain, "colours", 1.0) is plain
    assert with_features(plain, "none", 1.0) is plain
    assert with_features(mesh, "all", 0.0) is mesh


def test_parts_of_a_model_give_what_the_whole_gives(monkeypatch):
    """A model that is too large to be looked at together has the same weights in portions."""
    mesh = plate(image_of((np.abs(X - 5) < 0.75) & (np.abs(Y % 5 - 2) < 0.75)))
    mesh = replace(mesh, vertices=mesh.vertices[:, [2, 0, 1]])
    whole = with_features(mesh, "all", 2.0).features
    monkeypatch.setattr(features, "_CELLS", 1)
    parts = with_features(mesh, "all", 2.0).features
    np.testing.assert_allclose(parts.values, whole.values, atol=1e-6)


def test_features_add_to_what_is_painted():
    """The weights of vertices and of features are added, at points and in cells, and go along when a mesh is scaled."""
    mesh = replace(sphere(8), weight=np.full(len(sphere(8).vertices), 0.5))
    low = mesh.vertices.min(axis=0)
    field = WeightField(low - STUD, STUD, np.full((12, 12, 12), 2.0, np.float32))
    both = replace(mesh, features=field)
    face, points, *_ = next(surface_hits(both, low))
    np.testing.assert_allclose(weight_at(both, face, points), 2.5)
    np.testing.assert_allclose(weight_at(replace(both, weight=None), face, points), 2.0)
    assert cell_factors(both, low, (4, 3, 3)).max() == pytest.approx(3.5)
    larger = scale_mesh(both, 2.0)
    np.testing.assert_allclose(weight_at(larger, face, 2 * points), 2.5)
