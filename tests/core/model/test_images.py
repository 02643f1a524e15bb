"""Mirror images of parts: they fill the mirrored places, and the image of the image is the part itself."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model import columns, footprint, load_catalogue, part_images, solid

PARTS = load_catalogue().parts
FINE = 8


def filled(part, turn):
    """Return the part as samples of its box, by x, y and z."""
    xy = footprint(part, turn)
    wide, deep = xy.max(axis=0) + 1
    box = np.zeros((wide, FINE, deep, FINE, part.height * 2), bool)
    for (x, y), cell in zip(xy, solid(part, turn, FINE, 2), strict=True):
        box[x, :, y] = cell.transpose(2, 1, 0)
    return box.reshape(wide * FINE, deep * FINE, -1)


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("part", [part for part in PARTS if part.shaped], ids=lambda part: part.number)
def test_images_fill_what_is_mirrored(part, axis):
    """Solid, studs and sockets of the image are those of the part, mirrored."""
    images = part_images(PARTS, axis)
    row = PARTS.index(part)
    for turn in range(4):
        other, way = images[row, turn].tolist()
        assert images[other, way].tolist() == [row, turn]
        # samples that lie on a side may be on either side of it
        assert (np.flip(filled(part, turn), axis) != filled(PARTS[other], way)).mean() < 0.03
        own, image = columns(part, turn), columns(PARTS[other], way)
        place = own.xy.copy()
        place[:, axis] = own.xy[:, axis].max() - place[:, axis]
        for facts in ("stud", "socket"):
            first = set(map(tuple, place[getattr(own, facts)].tolist()))
            assert first == set(map(tuple, image.xy[getattr(image, facts)].tolist()))


def test_images_of_pairs_and_of_others():
    """The image of a left wedge plate is the right one; what is not laid for its shape is its own."""
    number = {part.number: row for row, part in enumerate(PARTS)}
    for axis in (0, 1):
        images = part_images(PARTS, axis)
        assert images[number["41770"], :, 0].tolist() == [number["41769"]] * 4
        assert images[number["26601"], :, 0].tolist() == [number["26601"]] * 4
        assert images[number["3001"]].tolist() == [[number["3001"], turn] for turn in range(4)]
