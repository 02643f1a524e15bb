"""Dominant colours, substituted images, and the brick colours that stand for them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from legorize_addon.core.colours.counted import count_colours, count_texels
from legorize_addon.core.colours.difference import ciede2000, lab_from_srgb
from legorize_addon.core.colours.dominant import (
    SurfaceColours,
    brick_colours,
    chosen_palette,
    dominant_colours,
    surface_colours,
)
from legorize_addon.core.errors import SettingsError
from legorize_addon.core.model.catalogue import load_catalogue
from tests.core.solids import sheet
from tests.core.textured import rgb_of, textured

SEVEN = np.array(
    [[200, 16, 46], [0, 0, 0], [255, 255, 255], [1, 120, 201], [250, 205, 0], [30, 31, 33], [129, 68, 20]], np.uint8
)
"""Seven colours, two of them alike, none of them a brick's."""


def colours_of(mesh, *, n_colours=64, sampling="surface", palette=None, one_to_one=False, seed=0) -> SurfaceColours:
    """Find the colours of a mesh, with the defaults of the settings."""
    catalogue = load_catalogue()
    return surface_colours(
        mesh,
        catalogue,
        n_colours=n_colours,
        texels=count_texels(mesh.images) if sampling == "image" else None,
        palette=catalogue.codes if palette is None else np.array(palette, np.int16),
        one_to_one=one_to_one,
        rng=np.random.default_rng(seed),
    )


def picture(size=64, seed=0) -> np.ndarray:
    """Draw a smooth picture of thousands of colours, (size, size, 3) uint8."""
    y, x = np.mgrid[:size, :size] / size
    shades = [np.sin(6 * x + 2 * y), np.cos(7 * y - x), np.sin(5 * x * y + 1)]
    noise = np.random.default_rng(seed).normal(0, 4, (size, size, 3))
    return np.clip(127 + 110 * np.stack(shades, axis=-1) + noise, 0, 255).astype(np.uint8)


def nearest(image, palette) -> np.ndarray:
    """Replace every texel by the nearest colour of a palette, the plain way."""
    wide = np.asarray(palette, np.int64)
    return wide[((image.astype(np.int64)[..., None, :] - wide) ** 2).sum(axis=-1).argmin(axis=-1)].astype(np.uint8)


def error(image, other) -> float:
    """Return the mean distance of two images in sRGB."""
    return float(np.linalg.norm(image.astype(float) - other, axis=-1).mean())


# -------------------------------------------------------------- Algorithm 1


@pytest.mark.parametrize("sampling", ["surface", "image"])
@pytest.mark.parametrize("n_colours", [7, 64])
def test_seven_colours_are_found_exactly(sampling, n_colours):
    """An image of seven colours has just those seven as dominant ones, and is its own substitution."""
    image = SEVEN[np.random.default_rng(1).integers(0, 7, (96, 80))]
    found = colours_of(textured(sheet(), image), n_colours=n_colours, sampling=sampling)
    np.testing.assert_array_equal(found.centres, SEVEN[np.lexsort(SEVEN.T[::-1])])
    np.testing.assert_array_equal(found.image(0), image)


@pytest.mark.parametrize("n_colours", [1, 2, 7, 24, 256])
def test_no_more_colours_than_asked_for(n_colours):
    """The substituted image has at most as many colours as asked for, each nearest to what it replaces."""
    image = picture()
    found = colours_of(textured(sheet(), image), n_colours=n_colours)
    shown = found.image(0)
    assert 1 <= len(np.unique(shown.reshape(-1, 3), axis=0)) <= len(found.centres) <= n_colours
    assert error(image, shown) == error(image, nearest(image, found.centres))


def test_two_runs_give_the_same_bytes():
    """The same seed finds the same colours, labels and codes to the last byte."""
    mesh = textured(sheet(), picture())
    first, second = (colours_of(mesh, n_colours=20, seed=5) for _ in range(2))
    assert first.centres.tobytes() == second.centres.tobytes()
    assert first.codes.tobytes() == second.codes.tobytes()
    assert first.labels[0].tobytes() == second.labels[0].tobytes()


@pytest.mark.parametrize("seed", range(5))
def test_rare_colour_becomes_its_nearest_dominant_one(seed):
    """Orange buttons on less than 0.5 % of an image of seven colours become red, the dominant colour nearest to it."""
    dominant = np.array([[200, 30, 30], [20, 60, 160], [240, 240, 240], [20, 20, 20], [30, 130, 60], [120, 70, 30],
                         [230, 170, 140]], np.uint8)  # fmt: skip
    image = np.repeat(dominant, 30, axis=0)[:, None].repeat(200, axis=1)
    image[3:9, 3:33] = [230, 120, 30]
    found = colours_of(textured(sheet(), image), n_colours=7, seed=seed)
    assert 180 / image[..., 0].size < 0.005
    assert np.abs(found.centres.astype(int) - dominant[np.lexsort(dominant.T[::-1])]).max() <= 3
    shown = found.image(0)[3:9, 3:33].reshape(-1, 3)
    assert (shown == nearest(np.uint8([230, 120, 30]), found.centres)).all()
    assert np.linalg.norm(shown[0] - [200.0, 30, 30]) < 4


@pytest.mark.parametrize("n_colours", [5, 16])
def test_substitution_beats_random_palettes(n_colours):
    """The substituted image is nearer to its source than with any of 20 palettes of colours drawn from it."""
    image = picture()
    rng = np.random.default_rng(2)
    palettes = [rng.choice(image.reshape(-1, 3), n_colours, replace=False) for _ in range(20)]
    ours = error(image, colours_of(textured(sheet(), image), n_colours=n_colours).image(0))
    assert ours <= min(error(image, nearest(image, palette)) for palette in palettes)


def test_background_that_no_surface_uses_counts_in_image_mode_only():
    """Three quarters of an atlas in magenta that no face uses: no dominant colour by surface, one by image."""
    image = picture(128)
    image[32:] = [255, 0, 255]
    mesh = sheet()
    mesh = textured(mesh, image, mesh.uvs * [1, 0.24])
    by_surface = colours_of(mesh, n_colours=6, sampling="surface").centres
    by_image = colours_of(mesh, n_colours=6, sampling="image").centres
    magenta = np.array([255.0, 0, 255])
    assert np.linalg.norm(by_surface - magenta, axis=1).min() > 60
    assert np.linalg.norm(by_image - magenta, axis=1).min() == 0


def test_colours_weigh_by_area_not_by_number_of_faces():
    """A plain colour on many small faces is rarer than one on a large face."""
    image = np.array([[[250, 0, 0], [0, 0, 250]]], np.uint8)
    mesh = sheet(20, 20)
    # all but the last square are shrunk to a hundredth; red on the small ones, blue on the large
    small = np.arange(len(mesh.faces)) % 400 < 399
    middle = np.where(small, 0.25, 0.75)[:, None, None] * [1, 0] + [0, 0.5]
    vertices = mesh.vertices[mesh.faces].reshape(-1, 3) * np.repeat(np.where(small, 0.01, 1), 3)[:, None]
    mesh = replace(mesh, vertices=vertices, faces=np.arange(len(vertices), dtype=np.int32).reshape(-1, 3))
    [centre] = colours_of(textured(mesh, image, np.broadcast_to(middle, (800, 3, 2))), n_colours=1).centres
    share = 399 * 1e-4 / (399 * 1e-4 + 1)
    np.testing.assert_allclose(centre, [250 * share, 0, 250 * (1 - share)], atol=0.6)


def test_images_are_clustered_together():
    """Plain materials, each an image of one texel, share one set of dominant colours."""
    mesh = sheet(8, 8)
    palette = picture(8).reshape(-1, 1, 1, 3)
    row = np.arange(len(mesh.faces)) % len(palette)
    mesh = replace(
        mesh, images=tuple(palette), face_image=row.astype(np.int32), image_clamp=np.zeros(len(palette), bool)
    )
    found = colours_of(mesh, n_colours=5)
    shown = np.array([found.image(k)[0, 0] for k in range(len(palette))])
    np.testing.assert_array_equal(shown, nearest(palette[:, 0, 0], found.centres))
    np.testing.assert_array_equal(found.of_faces(mesh), found.codes[[found.labels[k][0, 0] for k in row]])


@settings(max_examples=30)
@given(arrays(np.uint8, st.tuples(st.integers(1, 40), st.just(3))), st.integers(1, 6))
def test_dominant_colours_lie_among_the_texels(texels, n_colours):
    """Dominant colours are different, no more than asked for, and inside the box around the texels."""
    found = dominant_colours(count_colours(texels), n_colours=n_colours, rng=np.random.default_rng(0))
    assert len(np.unique(found, axis=0)) == len(found) <= n_colours
    assert (found >= texels.min(axis=0)).all()
    assert (found <= texels.max(axis=0)).all()
    if len(np.unique(texels, axis=0)) <= n_colours:
        np.testing.assert_array_equal(found, np.unique(texels, axis=0))


# -------------------------------------------------------------- brick colours


def test_brick_colours_stand_for_themselves():
    """Each colour of the catalogue is nearest to itself."""
    catalogue = load_catalogue()
    np.testing.assert_array_equal(brick_colours(catalogue.rgb, catalogue, palette=catalogue.codes), catalogue.codes)


@settings(max_examples=40)
@given(arrays(np.uint8, (5, 3)), st.booleans())
def test_codes_come_from_the_palette(centres, one_to_one):
    """Any colours become codes of the palette, and different ones where that is asked for."""
    catalogue = load_catalogue()
    palette = catalogue.codes[::4]
    codes = brick_colours(centres, catalogue, palette=palette, one_to_one=one_to_one)
    assert set(codes.tolist()) <= set(palette.tolist())
    if one_to_one:
        assert len(set(codes.tolist())) == len(centres)


@settings(max_examples=40)
@given(arrays(np.uint8, (4, 3)))
def test_nearest_brick_colour_by_ciede2000(centres):
    """Without black, the brick colour is the one that looks most alike."""
    catalogue = load_catalogue()
    palette = catalogue.codes[catalogue.codes != 0]
    difference = ciede2000(lab_from_srgb(centres)[:, None], lab_from_srgb(rgb_of(palette))[None])
    codes = brick_colours(centres, catalogue, palette=palette)
    np.testing.assert_array_equal(codes, palette[difference.argmin(axis=1)])


@pytest.mark.parametrize("value", [0, 1, 5, 10])
def test_pure_black_is_black(value):
    """Black stays Black, although LDraw shows that brick lighter than Dark Brown."""
    catalogue = load_catalogue()
    assert brick_colours(np.full((1, 3), value, np.uint8), catalogue, palette=catalogue.codes) == [0]


def test_one_to_one_has_the_least_sum_of_differences():
    """No exchange of two codes, and no other code, makes a one-to-one choice more alike."""
    catalogue = load_catalogue()
    rng = np.random.default_rng(4)
    palette = catalogue.codes[1:9]
    centres = rng.integers(0, 256, (5, 3)).astype(np.uint8)
    codes = brick_colours(centres, catalogue, palette=palette, one_to_one=True)
    difference = ciede2000(lab_from_srgb(centres)[:, None], lab_from_srgb(rgb_of(palette))[None])
    row = np.searchsorted(palette, codes)
    least = difference[np.arange(5), row].sum()
    others = [difference[np.arange(5), rng.permutation(8)[:5]].sum() for _ in range(2000)]
    assert least <= min(others) + 1e-9


def test_no_two_dominant_colours_collapse_one_to_one():
    """Shades of one brick colour keep codes of their own when asked to, and share one otherwise."""
    shades = np.stack([[150 + 3 * k, 20, 20 + k] for k in range(6)]).astype(np.uint8)
    mesh = textured(sheet(), shades[None])
    assert len(set(colours_of(mesh).codes.tolist())) < 6
    assert len(set(colours_of(mesh, one_to_one=True).codes.tolist())) == 6


def test_too_few_brick_colours_for_one_to_one_are_refused():
    """Seven dominant colours cannot have one of three brick colours each."""
    with pytest.raises(SettingsError, match=r"^7 dominant colours need as many brick colours, but there are 3: .*\.$"):
        colours_of(textured(sheet(), SEVEN[None]), palette=[0, 4, 15], one_to_one=True)


def test_only_the_chosen_palette_is_used():
    """Every texel becomes a colour of the palette."""
    found = colours_of(textured(sheet(), picture()), palette=[1, 4, 15])
    assert set(found.codes.tolist()) == {1, 4, 15}


@pytest.mark.parametrize(
    ("text", "codes"),
    [("4", [4]), (" 4,14 ", [4, 14]), ("14, 4, 4,", [4, 14]), ("4\n14", [4, 14]), ("0,1,15", [0, 1, 15])],
)
def test_palette_names_codes(text, codes):
    """A palette is a list of codes in any order, each counted once."""
    np.testing.assert_array_equal(chosen_palette(text, load_catalogue()), codes)


@pytest.mark.parametrize("text", ["", "  "])
def test_empty_palette_is_all_colours(text):
    """Nothing said means everything that is made today."""
    np.testing.assert_array_equal(chosen_palette(text, load_catalogue()), load_catalogue().codes)


@pytest.mark.parametrize(
    ("text", "words"),
    [("red", "red"), ("4, red, 99999", "red, 99999"), (",", "nothing"), ("-1", "-1"), ("4;14", "4;14"), ("4.0", "4.0")],
)
def test_unknown_codes_are_refused(text, words):
    """What is not the code of a colour made today is named in one sentence."""
    with pytest.raises(SettingsError) as refusal:
        chosen_palette(text, load_catalogue())
    assert str(refusal.value).startswith(f"The palette names {words}: ")
    assert str(refusal.value).endswith(".")


# -------------------------------------------------------------- looking colours up


def stripes(*, clamp: bool) -> SurfaceColours:
    """Find the colours of an image whose row 0 is red and blue, and whose row 1 is green and white."""
    return colours_of(textured(sheet(), rgb_of([4, 1, 2, 15]).reshape(2, 2, 3), clamp=clamp))


def test_row_zero_is_the_bottom():
    """Image coordinates run to the right and up, as texels do from row 0."""
    uv = np.array([[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]])
    np.testing.assert_array_equal(stripes(clamp=False).at(np.zeros(4, int), uv), [4, 1, 2, 15])


def test_coordinates_outside_repeat_or_take_the_edge():
    """Far outside, an image repeats, also to the left and below; clamped, it takes its edge."""
    uv = np.array([[1.25, 0.25], [-0.25, 0.25], [7.75, -3.25], [-9.9, 9.9]])
    np.testing.assert_array_equal(stripes(clamp=False).at(np.zeros(4, int), uv), [4, 1, 15, 15 - 13])
    np.testing.assert_array_equal(stripes(clamp=True).at(np.zeros(4, int), uv), [1, 4, 1, 2])


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1), st.booleans(), st.integers(1, 9), st.integers(1, 9))
def test_boxes_of_one_colour_are_never_told_apart_wrongly(seed, clamp, height, width):
    """A box that is said to have one colour has it at every point of it."""
    rng = np.random.default_rng(seed)
    image = rgb_of([4, 1])[(rng.random((height, width)) < rng.choice([0.1, 0.5])).astype(int)]
    found = colours_of(textured(sheet(), image, clamp=clamp), sampling="image")
    low = rng.uniform(-1.5, 1.5, (40, 2))
    high = low + rng.choice([0, 0.05, 0.3, 1.2], (40, 1)) * rng.random((40, 2))
    zero = np.zeros(40, int)
    inside = [found.at(zero, low + share * (high - low)) for share in rng.random((60, 40, 2))]
    inside += [found.at(zero, low), found.at(zero, high)]
    plain = ~found.varied(zero, low, high)
    assert (np.array(inside)[:, plain] == inside[0][plain]).all()


def test_boxes_of_one_colour_are_found():
    """Boxes within a stripe are plain, boxes across its border are not; an image of one colour is plain everywhere."""
    image = np.repeat(rgb_of([4, 1]), 8, axis=0)[None].repeat(8, axis=0)
    found = colours_of(textured(sheet(), image))
    low, high = np.array([[0.05, 0.1], [0.3, 0.1], [0.7, 0.5]]), np.array([[0.3, 0.9], [0.6, 0.2], [0.71, 0.9]])
    np.testing.assert_array_equal(found.varied(np.zeros(3, int), low, high), [False, True, False])
    plain = colours_of(textured(sheet(), rgb_of([4])[None]))
    assert not plain.varied(np.zeros(1, int), np.array([[-5.0, -5]]), np.array([[9.0, 9]])).any()


def test_faces_of_one_colour_are_known():
    """A face has one colour where its corners' box does, and -1 where it may have several."""
    image = np.repeat(rgb_of([4, 1]), [22, 18], axis=0)[None].repeat(40, axis=0)
    mesh = sheet(6, 1)
    mesh = textured(mesh, image, 0.01 + 0.98 * mesh.uvs)
    u = mesh.uvs[..., 0]
    expected = np.where(u.max(axis=1) < 0.55, 4, np.where(u.min(axis=1) > 0.55, 1, -1))
    assert set(expected.tolist()) == {4, 1, -1}
    np.testing.assert_array_equal(colours_of(mesh).of_faces(mesh), expected)


def test_what_counts_more_has_more_of_the_colours():
    """The one dominant colour of two equal halves is nearer to the one that counts four times."""
    image = np.array([[[250, 0, 0], [0, 0, 250]]], np.uint8)
    mesh = textured(sheet(2, 1), image, np.broadcast_to([[[0.25, 0.5]]] * 2 + [[[0.75, 0.5]]] * 2, (4, 3, 2)))
    left = mesh.vertices[mesh.faces][..., 0].max(axis=1) <= 0.5
    mesh = replace(mesh, uvs=np.where(left, 0.25, 0.75)[:, None, None] * [1, 0] + np.broadcast_to([0, 0.5], (4, 3, 2)))
    [centre] = colours_of(replace(mesh, weight=np.full(6, 3.0)), n_colours=1).centres
    np.testing.assert_allclose(centre, [125, 0, 125], atol=1)
    # two of three corners of one face of the left half, and one of the other, are at its rim
    [centre] = colours_of(replace(mesh, weight=3.0 * (mesh.vertices[:, 0] == 0)), n_colours=1).centres
    np.testing.assert_allclose(centre, [250 * 5 / 7, 0, 250 * 2 / 7], atol=1)
