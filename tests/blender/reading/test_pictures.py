"""Images for mosaics: as they are seen, whatever their kind."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
from PIL import Image

from legorize_addon.core.errors import MeshError
from legorize_addon.reading.pictures import load_picture, picture_from
from legorize_addon.reading.shown import image_of

PIXELS = np.random.default_rng(2).integers(0, 256, (3, 5, 4), dtype=np.uint8)


def top_down(picture) -> np.ndarray:
    """Return the colours of a picture, the first row on top."""
    return picture.rgb[::-1]


@pytest.mark.parametrize("kind", ["RGB", "RGBA", "L", "P", "16 bits"])
def test_pixels_are_those_of_the_file(kind: str, tmp_path: Path) -> None:
    """Colour, alpha, grey, palettes and 16 bits; row 0 of a picture is the bottom."""
    rgba = PIXELS.copy()
    rgba[..., 3] = np.where(PIXELS[..., 3] > 127, 255, 0)
    image = Image.fromarray(rgba, "RGBA")
    expected, alpha = rgba[..., :3], np.full((3, 5), 255)
    if kind == "RGB":
        image = image.convert("RGB")
    elif kind == "RGBA":
        alpha = rgba[..., 3]
    elif kind == "L":
        image = image.convert("RGB").convert("L")
        expected = np.repeat(np.asarray(image)[..., None], 3, axis=2)
    elif kind == "P":
        image = image.convert("RGB").quantize(16)
        expected = np.asarray(image.convert("RGB"))
    else:
        image = Image.fromarray(rgba[..., 0].astype(np.uint16) * 257)
        expected = np.repeat(rgba[..., :1], 3, axis=2)
    image.save(tmp_path / "a.png")
    picture, remarks = load_picture(tmp_path / "a.png")
    seen = alpha > 0
    difference = np.abs(top_down(picture).astype(int) - expected)[seen]
    assert difference.max() <= (1 if kind == "16 bits" else 0)
    np.testing.assert_array_equal(picture.alpha[::-1], alpha)
    assert remarks == ()
    assert not len(bpy.data.images)


def test_photographs_are_turned_as_the_camera_was(tmp_path: Path) -> None:
    """From a file and from an image of the scene alike: a quarter turn makes it upright."""
    tall = np.zeros((16, 32, 3), np.uint8)
    tall[:, :16, 0] = 255
    exif = Image.Exif()
    exif[274] = 6
    Image.fromarray(tall).save(tmp_path / "a.jpg", exif=exif, quality=95)
    picture, _ = load_picture(tmp_path / "a.jpg")
    assert picture.size == (16, 32)
    assert top_down(picture)[4, 8, 0] > 200 > 50 > top_down(picture)[28, 8, 0]
    image = bpy.data.images.load(str(tmp_path / "a.jpg"))
    np.testing.assert_array_equal(picture_from(image)[0].rgb, picture.rgb)


def test_images_of_empties() -> None:
    """The first empty that shows an image; others, and other objects, do not count."""
    image = bpy.data.images.new("shown", 2, 2)
    plain, shown = (bpy.data.objects.new(name, None) for name in ("plain", "shown"))
    assert image_of([plain]) is None
    shown.empty_display_type, shown.data = "IMAGE", image
    assert image_of([plain, shown]) == image


def test_what_cannot_be_read_is_refused(tmp_path: Path) -> None:
    """Missing, damaged, printed, or in a colour space of its own: one sentence each."""
    with pytest.raises(MeshError, match="There is no file"):
        load_picture(tmp_path / "a.png")
    whole = tmp_path / "whole.png"
    Image.fromarray(PIXELS).save(whole)
    (tmp_path / "cut.png").write_bytes(whole.read_bytes()[:40])
    with pytest.raises(MeshError, match=r"cut\.png"):
        load_picture(tmp_path / "cut.png")
    Image.new("CMYK", (4, 4)).save(tmp_path / "inks.jpg")
    with pytest.raises(MeshError, match="CMYK"):
        load_picture(tmp_path / "inks.jpg")
    image = bpy.data.images.load(str(whole))
    image.colorspace_settings.name = "ACEScg" if "ACEScg" in _spaces(image) else "Filmic sRGB"
    with pytest.raises(MeshError, match="save it as sRGB"):
        picture_from(image)


def _spaces(image: bpy.types.Image) -> list[str]:
    return [each.identifier for each in image.colorspace_settings.bl_rna.properties["name"].enum_items]
