"""LDraw text: where it puts every part."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.order import steps_of
from legorize_addon.core.files.ldraw import ldraw_matrix, write_ldr
from legorize_addon.core.files.ldraw_mpd import write_mpd
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import footprint
from legorize_addon.core.units import PLATE, STUD
from tests.core.any_bricks import CATALOGUE, ORIENTATIONS, any_bricks, everything, table

unhurried = settings(deadline=None, max_examples=50)
GOLDEN = Path(__file__).parents[2] / "golden" / "catalogue.ldr"


def parts_in(text):
    """Return (number, colour, matrix, offset) of every part line, read by hand."""
    lines = [line.split() for line in text.splitlines() if line.startswith("1 ")]
    return [
        (words[14], int(words[1]), np.array(words[5:14], float).reshape(3, 3), np.array(words[2:5], float))
        for words in lines
    ]


@unhurried
@given(any_bricks(), st.randoms(use_true_random=False))
def test_text_does_not_depend_on_the_order_of_the_bricks(bricks, random):
    """Shuffled bricks, or bricks turned by their own symmetry, give the same bytes."""
    rows = list(range(len(bricks)))
    random.shuffle(rows)
    shuffled = bricks.take(np.array(rows, np.int64))
    turns = np.array([part.turns for part in CATALOGUE.parts])[shuffled.part]
    turned = Bricks(
        shuffled.part,
        shuffled.corner,
        ((shuffled.turn + turns) % 4).astype(np.uint8),
        shuffled.colour,
        shuffled.role,
        shuffled.piece,
        shuffled.step,
    )
    texts = {write_ldr(Assembly(each, CATALOGUE), name="m.ldr", title="m") for each in (turned, bricks)}
    assert len(texts) == 1


@pytest.mark.parametrize(("row", "turn"), ORIENTATIONS, ids=lambda value: str(value))
def test_part_covers_its_footprint(row, turn):
    """By LDraw's own rules for origin and axes, each orientation of each part fills the cells of its footprint."""
    part = CATALOGUE.parts[row]
    corner = np.array([3, -2, 5])
    text = write_ldr(Assembly(table([(row, *corner, turn, 4, 0, 0, 0)]), CATALOGUE), name="m.ldr", title="m")
    [(name, colour, matrix, offset)] = parts_in(text)
    assert (name, colour) == (f"{part.number}.dat", 4)
    if part.corner:
        local = np.array([[0, 0, 0], [20, 0, 0], [0, 0, 20]])
    elif part.sloped:
        # the high end is at the origin, and the part falls towards -z
        local = np.array([[20 * j - 10 * (part.width - 1), 0, -20 * i] for i, j in np.ndindex(part.length, part.width)])
        # that of curves is in their middle
        local[:, 2] += 10 * (part.length - 1) * (part.profile in ("curved", "bow"))
    elif part.wedge:
        # all corners of its box but those that are cut off whole, by their distance from that to low x and low y
        own = np.argwhere(np.ones((part.length, part.width), dtype=bool))
        own = own[np.isin(own @ [9, 1], footprint(part, 0) @ [9, 1])]
        local = np.stack([20 * own[:, 1], 0 * own[:, 0], -20 * own[:, 0]], axis=1).astype(np.float64)
        local += np.array([-10 * (part.width - 1), 0, 10 * (part.length - 1)])
    else:
        sides = np.array([[i, 0, j] for i in range(part.length) for j in range(part.width)])
        local = 20 * sides - 10 * np.array([part.length - 1, 0, part.width - 1])
    centres = local @ matrix.T + offset
    cells = np.floor(np.column_stack([centres[:, 0] / 20, centres[:, 2] / 20]))
    assert set(map(tuple, cells)) == set(map(tuple, footprint(part, turn) + corner[:2]))
    # the library has the origin of cheese slopes and of short curves at their lower face
    above = 8 * part.height * (part.profile in ("cheese", "curved"))
    top, bottom = (matrix @ [0, depth - above, 0] + offset for depth in (0, 8 * part.height))
    assert -bottom[1] / 8 == corner[2]
    assert -top[1] / 8 == corner[2] + part.height


def test_catalogue_model_matches_the_golden_file():
    """Every part in each of its orientations: the text is the one on record, line ends apart."""
    bricks = everything()
    assert len(bricks) == 24 + 24 + 6 + 16 + 9 + 4 + 24 * 4 + 2 * 4 + 11 * 4
    text = write_ldr(Assembly(bricks, CATALOGUE), name="catalogue.ldr", title="Every part in each of its orientations")
    assert text.replace("\r\n", "\n") == GOLDEN.read_text(encoding="utf-8")


def test_lines_end_as_in_the_library():
    """Every line ends in CRLF, and no bare line end is left."""
    assembly = Assembly(everything(), CATALOGUE)
    document = write_mpd(assembly, steps_of(assembly), name="m.ldr", title="m")
    for text in (write_ldr(assembly, name="m.ldr", title="m"), document):
        assert text.endswith("\r\n")
        assert "\n" not in text.replace("\r\n", "")
        assert "\r" not in text.replace("\r\n", "")


def test_header_and_steps():
    """The first lines are title, name and author; each step that has bricks ends in one STEP line."""
    bricks = table([(0, 0, 0, 0, 0, 4, 0, 0, 3), (0, 1, 0, 0, 0, 4, 0, 0, 7), (0, 2, 0, 0, 0, 4, 0, 0, 7)])
    lines = write_ldr(Assembly(bricks, CATALOGUE), name="m.ldr", title="A title\nof two lines").split("\r\n")
    assert lines[:3] == ["0 A title of two lines", "0 Name: m.ldr", "0 Author: Legorize"]
    assert [line[:6] for line in lines if line.startswith(("1", "0 STEP"))] == [
        "1 4 10", "0 STEP", "1 4 30", "1 4 50", "0 STEP",
    ]  # fmt: skip


def test_file_to_follow_is_named_with_the_numbers_of_its_steps():
    """The first lines say where to look, and each step what it is called there."""
    bricks = table([(0, 0, 0, 0, 0, 4, 0, 0, 3), (0, 1, 0, 0, 0, 4, 0, 0, 7), (0, 2, 0, 0, 0, 4, 0, 0, 7)])
    lines = write_ldr(Assembly(bricks, CATALOGUE), name="m.ldr", title="m", follow="m.mpd").split("\r\n")
    assert "m.mpd" in lines[3]
    assert [line[:9] for line in lines if line.startswith(("1", "0 STEP", "0 // S"))] == [
        "0 // Step", "1 4 10 -2", "0 STEP", "0 // Step", "1 4 30 -2", "1 4 50 -2", "0 STEP",
    ]  # fmt: skip
    assert [line for line in lines if line.startswith("0 // S")] == ["0 // Step 4", "0 // Step 8"]


def test_empty_model_is_a_header():
    """No bricks are written as three lines of header."""
    nothing = Assembly(table([]), CATALOGUE)
    document = write_mpd(nothing, steps_of(nothing), name="m.ldr", title="m")
    for text in (write_ldr(nothing, name="m.ldr", title="m"), document):
        assert not [line for line in text.splitlines() if not line.startswith("0 ")]


@unhurried
@given(
    st.tuples(*[st.floats(-1e3, 1e3)] * 3),
    st.floats(0.01, 100),
    st.sampled_from([1.0, 10.0, 1000.0]),
    st.tuples(*[st.integers(-50, 50)] * 3),
)
def test_matrix_takes_scene_points_to_the_file(origin, scale, mm_per_unit, cell):
    """The corner of any cell, seen in the scene, lands on its place in LDU: 20 a stud, 8 a plate, -y up."""
    origin, cell = np.array(origin), np.array(cell)
    scene = (origin + cell * [STUD, STUD, PLATE]) / scale / mm_per_unit
    matrix = ldraw_matrix(origin, scale, mm_per_unit)
    x, y, z, one = matrix @ [*scene, 1]
    np.testing.assert_allclose([x, y, z], [20 * cell[0], -8 * cell[2], 20 * cell[1]], atol=1e-8)
    assert one == 1
    # equal along all axes and not mirrored
    linear = matrix[:3, :3] / (2.5 * scale * mm_per_unit)
    np.testing.assert_allclose(linear @ linear.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(linear) == pytest.approx(1)
