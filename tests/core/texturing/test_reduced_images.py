"""Images no finer than matters at a stud, and the mean of what changes within one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.colours.difference import linear_from_srgb, srgb_from_linear
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.texturing.reduced_images import TEXELS_PER_STUD, reduce_images
from tests.core.solids import box, sheet
from tests.core.textured import rgb_of, textured

BLACK, GREY, WHITE = 0, 71, 15


def flat(image: np.ndarray, *, studs: float, repeats: float = 1.0, clamp: bool = False) -> TriangleMesh:
    """Return a square of some studs under an image."""
    square = sheet(1, 1)
    return textured(replace(square, vertices=square.vertices * studs * 8), image, square.uvs * repeats, clamp=clamp)


def checker(n: int, first: int = 0, second: int = 255) -> np.ndarray:
    """Return an image of n x n texels in two greys by turns."""
    odd = np.indices((n, n)).sum(axis=0) % 2
    return np.repeat(np.where(odd, second, first)[..., None], 3, axis=2).astype(np.uint8)


def test_images_that_are_coarse_enough_stay() -> None:
    """Up to the bound of texels a stud the mesh keeps its very image."""
    image = np.random.default_rng(0).integers(90, 110, (64, 64, 3)).astype(np.uint8)
    mesh = flat(image, studs=64 / TEXELS_PER_STUD)
    assert reduce_images(mesh, least=0.5).images[0] is image


def test_finer_images_become_means_in_linear_light() -> None:
    """Four times as many texels as matter are halved twice; black and white become the grey of half the light."""
    mesh = flat(checker(64), studs=64 / TEXELS_PER_STUD / 4)
    [image] = reduce_images(mesh, least=0.5).images
    assert image.shape == (16, 16, 3)
    np.testing.assert_array_equal(image, srgb_from_linear(np.full((16, 16, 3), 0.5)))


@pytest.mark.parametrize("repeats", [1e4, 1e6, 1e12, 1e30])
def test_no_edge_crosses_more_texels_than_matter(repeats: float) -> None:
    """Whatever the image coordinates are, each face has a texel or two left, and the mean colour."""
    mesh = flat(checker(64), studs=10, repeats=repeats)
    reduced = reduce_images(mesh, least=0.5)
    assert [image.shape for image in reduced.images] == [(1, 1, 3)]
    assert reduced.images[0][0, 0].tolist() == [188, 188, 188]


def test_faces_without_area_are_bounded_too() -> None:
    """A needle over a million texels crosses no more of them than its length allows."""
    mesh = flat(checker(64), studs=1)
    needle = replace(
        mesh,
        vertices=np.array([(0, 0, 0), (8, 0, 0), (16.0, 0, 0)]),
        faces=np.array([[0, 1, 2]], dtype=np.int32),
        uvs=np.array([[(0, 0), (1e4, 0), (2e4, 0.0)]]),
        face_image=np.zeros(1, dtype=np.int32),
    )
    reduced = reduce_images(needle, least=0.5)
    size = np.array(reduced.images[0].shape[1::-1])
    assert reduced.images[0].shape[1] == 1 or (np.ptp(reduced.uvs[0], axis=0) * size).max() < 1000


def test_great_coordinates_take_the_same_texels() -> None:
    """A repeated image far out shows what it shows near zero."""
    image = np.random.default_rng(2).integers(0, 255, (4, 4, 3)).astype(np.uint8)
    near = flat(image, studs=16)
    far = replace(near, uvs=np.add(near.uvs, (123456.0, -98765.0)))
    np.testing.assert_allclose(reduce_images(far, least=0.5).uvs, near.uvs, atol=1e-9)


def test_hidden_texels_have_no_say() -> None:
    """Means take what is seen alone, and what is hidden takes the colour of what is near."""
    image, alpha = np.zeros((64, 64, 3), np.uint8), np.zeros((64, 64), np.uint8)
    image[:, :20], alpha[:, :20] = (30, 180, 40), 255
    image[:, 40:], alpha[:, 40:] = (200, 20, 30), 255
    for studs in (4, 1):
        mesh = replace(flat(image, studs=studs, clamp=True), opacities=(alpha,))
        found = reduce_images(mesh, least=0.5, mean=False).images[0]
        third = len(found) // 3
        np.testing.assert_allclose(found[:, : third // 2].reshape(-1, 3).mean(axis=0), (30, 180, 40), atol=1)
        assert (found.reshape(-1, 3).max(axis=1) > 100).all()


@pytest.mark.parametrize(("n", "repeats"), [(48, 1), (2, 40), (2, 1000), (4, 15)])
def test_a_fine_checker_is_built_in_grey(n: int, repeats: int) -> None:
    """A board of black and white squares finer than a stud becomes grey, on top and on the sides; or not, as asked."""
    body = box((0, 0, 0), (96, 96, 48))
    uvs = np.stack([body.vertices[body.faces][..., [0, 1]].sum(axis=2), body.vertices[body.faces][..., 2]], axis=2)
    top = np.abs(body.normals[:, 2]) > 0
    uvs[top] = body.vertices[body.faces][top][..., :2]
    mesh = textured(body, checker(n), uvs / 96 * repeats)
    quick = Settings(width=12, layout="fast", supports="none", strengthen=False)
    colours = legorize(mesh, quick).bricks.colour
    assert set(colours.tolist()) <= {71, 72, 7, 8, 503, 151}
    crisp = legorize(mesh, replace(quick, fine_texture="texels")).bricks.colour
    assert repeats > 15 or {BLACK, WHITE} & set(crisp.tolist())


def test_squares_of_two_studs_stay_black_and_white() -> None:
    """What is coarser than a stud is built as it is."""
    body = box((0, 0, 0), (96, 96, 19.2))
    mesh = textured(body, checker(6), body.vertices[body.faces][..., :2] / 96)
    build = legorize(mesh, Settings(width=12))
    top = build.grid.colour[-1, -1]
    assert set(top[top >= 0].tolist()) == {BLACK, WHITE}


def test_half_of_the_light_is_the_grey_of_bricks() -> None:
    """The mean of black and white in linear light is sRGB 188, nearest to Light Bluish Gray."""
    assert srgb_from_linear(linear_from_srgb(rgb_of([BLACK, WHITE])).mean(axis=0)).min() > 150


def test_weighted_faces_keep_their_texels() -> None:
    """Of a checker finer than a stud on two squares, the one that counts more keeps black and white."""
    mesh = textured(sheet(2, 1), checker(64), sheet(2, 1).uvs)
    mesh = replace(mesh, vertices=mesh.vertices * (64, 32, 8), weight=np.where(mesh.vertices[:, 0] == 0, 1.0, 0.0))
    reduced = reduce_images(mesh, least=0.5)
    right = (mesh.weight[mesh.faces] == 0).all(axis=1)
    colours = [np.unique(reduced.images[row]) for row in reduced.face_image]
    assert [len(each) == 1 for each in colours] == right.tolist()
    assert right.any()
    assert not right.all()
