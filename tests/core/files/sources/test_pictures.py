"""Heads of image files, against Pillow's."""

from __future__ import annotations

import io
from contextlib import suppress

import numpy as np
import pytest
from PIL import Image, ImageOps

from legorize_addon.core.errors import MeshError
from legorize_addon.core.files.sources.pictures import check_picture

PIXELS = np.random.default_rng(0).integers(0, 256, (3, 5, 3), dtype=np.uint8)


def saved(path, image, **options):
    """Write an image and return its path."""
    image.save(path, **options)
    return path


@pytest.mark.parametrize("kind", ["png", "jpg"])
@pytest.mark.parametrize("orientation", range(1, 9))
def test_images_are_turned_as_pillow_does(tmp_path, kind, orientation):
    """All eight ways of holding a camera, in both kinds of files."""
    image = Image.fromarray(PIXELS)
    exif = Image.Exif()
    exif[274] = orientation
    head = check_picture(saved(tmp_path / f"a.{kind}", image, exif=exif))
    assert head.size == (5, 3)
    assert head.orientation == orientation
    with_tag = Image.open(saved(tmp_path / "tagged.png", image, exif=exif))
    expected = np.asarray(ImageOps.exif_transpose(with_tag))
    np.testing.assert_array_equal(head.upright(PIXELS[::-1])[::-1], expected)


@pytest.mark.parametrize(("mode", "kind"), [("L", "jpg"), ("L", "png"), ("I;16", "png"), ("RGBA", "png"), ("P", "png")])
def test_other_kinds_are_let_through(tmp_path, mode, kind):
    """Grey, 16 bits, alpha and palettes have a size, and stay as they are."""
    image = Image.new(mode, (7, 4))
    head = check_picture(saved(tmp_path / f"a.{kind}", image))
    assert (head.size, head.orientation) == ((7, 4), 1)


def test_inks_are_refused(tmp_path):
    """CMYK is the language of printers."""
    with pytest.raises(MeshError, match="CMYK"):
        check_picture(saved(tmp_path / "a.jpg", Image.new("CMYK", (4, 4))))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"GIF89a", "neither a PNG nor a JPEG"),
        (b"\xff\xd8\xff\xe0\x00\x10JFIF", "its header has no end"),
        (b"\x89PNG\r\n\x1a\n", "its header says no size"),
        (b"\xff\xd8\xff\xc0\x00\x11\x0c\x00\x01\x00\x01\x03" + bytes(12), "12 bits"),
        (b"\xff\xd8\xff\xc0\x00\x11\x08\x00\x00\x00\x01\x03" + bytes(12), "says no size"),
    ],
)
def test_damaged_heads_are_refused(tmp_path, content, message):
    """Each with its reason."""
    path = tmp_path / "a.jpg"
    path.write_bytes(content)
    with pytest.raises(MeshError, match=message):
        check_picture(path)


def test_any_cut_is_refused_or_read(tmp_path):
    """A file that ends anywhere gives a head or a sentence, never a traceback; so do wild bytes in its Exif data."""
    exif = Image.Exif()
    exif[274] = 6
    stream = io.BytesIO()
    Image.fromarray(PIXELS).save(stream, "jpeg", exif=exif)
    whole, path, rng = stream.getvalue(), tmp_path / "a.jpg", np.random.default_rng(1)
    read = 0
    for length in range(0, len(whole), 3):
        path.write_bytes(whole[:length])
        with suppress(MeshError):
            read += check_picture(path).size == (5, 3)
    assert read > 0
    for _ in range(100):
        wild = bytearray(whole)
        wild[rng.integers(20, 60)] = rng.integers(256)
        path.write_bytes(wild)
        with suppress(MeshError):
            assert 1 <= check_picture(path).orientation <= 8
