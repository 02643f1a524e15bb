"""The gallery of the five kinds: what is pictured, and the sheet of all pictures."""

from __future__ import annotations

import bpy
import numpy as np

from scripts.gallery import SHEET, picture, put_together, shots
from scripts.research.five_kinds import KINDS


def test_the_sheet_has_every_picture():
    """Each kind is pictured both ways, and every picture has one place on the sheet."""
    names = [f"{shot.kind} {shot.way}" for shot in shots(list(KINDS))]
    assert sorted(names) == sorted(name for row in SHEET for name in row)
    assert {f"{kind} {way}" for kind in KINDS for way in ("default", "as published")} <= set(names)


def test_pictures_keep_their_places(tmp_path):
    """In half their size: a picture is where its row and column are, the first one at the top left."""
    names = [name for row in SHEET for name in row]
    for number, name in enumerate(names):
        image = bpy.data.images.new(name, 32, 24)
        pixels = np.zeros((24, 32, 4), dtype=np.float32)
        pixels[..., 0], pixels[..., 3] = number / len(names), 1
        # black and white within each four
        pixels[::2, ::2, 1] = pixels[1::2, 1::2, 1] = 1
        image.pixels.foreach_set(pixels.ravel())
        image.filepath_raw, image.file_format = str(picture(tmp_path, name)), "PNG"
        image.save()
        bpy.data.images.remove(image)
    sheet = bpy.data.images.load(str(put_together(tmp_path)))
    assert tuple(sheet.size) == (16 * len(SHEET[0]), 12 * len(SHEET))
    found = np.array(sheet.pixels[:]).reshape(len(SHEET), 12, len(SHEET[0]), 16, 4)[::-1]
    np.testing.assert_allclose(found[:, 6, :, 8, 0].ravel(), np.arange(len(names)) / len(names), atol=0.02)
    np.testing.assert_allclose(found[:, 6, :, 8, 1], 0.5, atol=0.02)
    assert not [image for image in bpy.data.images if image.name == "sheet"]
