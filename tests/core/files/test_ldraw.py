"""LDraw text: where it puts every part, and that it reads back to the same bricks."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.order import steps_of
from legorize_addon.core.errors import BuildError
from legorize_addon.core.files.ldraw import ldraw_matrix, read_ldr, write_ldr
from legorize_addon.core.files.ldraw_mpd import write_mpd
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import footprint
from legorize_addon.core.units import PLATE, STUD
from tests.core.any_bricks import CATALOGUE, ORIENTATIONS, any_bricks, everything, multiset, table

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
@given(any_bricks())
def test_read_gives_back_the_bricks(bricks):
    """Part, place, turn up to symmetry, colour, role, piece and step survive writing and reading."""
    read = read_ldr(write_ldr(Assembly(bricks, CATALOGUE), name="m.ldr", title="m"), CATALOGUE)
    assert multiset(read) == multiset(bricks)


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
    else:
        sides = np.array([[i, 0, j] for i in range(part.length) for j in range(part.width)])
        local = 20 * sides - 10 * np.array([part.length - 1, 0, part.width - 1])
    centres = local @ matrix.T + offset
    cells = np.floor(np.column_stack([centres[:, 0] / 20, centres[:, 2] / 20]))
    assert set(map(tuple, cells)) == set(map(tuple, footprint(part, turn) + corner[:2]))
    top, bottom = (matrix @ [0, depth, 0] + offset for depth in (0, 8 * part.height))
    assert -bottom[1] / 8 == corner[2]
    assert -top[1] / 8 == corner[2] + part.height


def test_catalogue_model_matches_the_golden_file():
    """Every part in each of its orientations: the text is the one on record, line ends apart."""
    bricks = everything()
    assert len(bricks) == 24 + 24 + 6
    text = write_ldr(Assembly(bricks, CATALOGUE), name="catalogue.ldr", title="Every part in each of its orientations")
    assert text.replace("\r\n", "\n") == GOLDEN.read_text(encoding="utf-8")


def test_golden_file_reads_as_the_catalogue_model():
    """The file on record reads back to every part in each of its orientations."""
    assert multiset(read_ldr(GOLDEN.read_text(encoding="utf-8"), CATALOGUE)) == multiset(everything())


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


def test_sub_model_is_turned_moved_and_coloured_by_its_call():
    """A sub-model's brick is turned with it, moved with it, and takes its colour where it has none of its own."""
    text = """0 FILE main.ldr
1 14 100 -24 40 0 0 -1 0 1 0 1 0 0 arm.ldr
0 FILE Arm.ldr
1 16 40 -24 20 1 0 0 0 1 0 0 0 1 3001.dat
1 4 90 -8 30 1 0 0 0 1 0 0 0 1 3024.dat
"""
    read = read_ldr(text, CATALOGUE)
    # the brick's centre (40, 20) comes to (100 - 20, 40 + 40), the plate's (90, 30) to (100 - 30, 40 + 90)
    assert read.corner.tolist() == [[3, 2, 3], [3, 6, 3]]
    assert read.turn.tolist() == [1, 0]
    assert read.colour.tolist() == [14, 4]


def test_empty_model_is_a_header():
    """No bricks are written as three lines of header and read back as no bricks."""
    nothing = Assembly(table([]), CATALOGUE)
    document = write_mpd(nothing, steps_of(nothing), name="m.ldr", title="m")
    for text in (write_ldr(nothing, name="m.ldr", title="m"), document):
        assert len(read_ldr(text, CATALOGUE)) == 0
    assert len(read_ldr("", CATALOGUE)) == 0


def test_files_of_other_programs_can_be_read():
    """Decimal points, capitals, LF line ends, aliases and comments are understood; coordinates snap to the grid."""
    text = "0 by hand\n0 // remark\n1 4 20.0004 -8.000 10 1 0 0 0 1.00 0 -0.0 0 1 3023B.DAT\n0 ROTSTEP 30 20 0\n"
    read = read_ldr(text + "1 0x4 10 -32 10 1 0 0 0 1 0 0 0 1 3005.dat", CATALOGUE)
    assert [CATALOGUE.parts[row].number for row in read.part] == ["3023", "3005"]
    assert read.corner.tolist() == [[0, 0, 0], [0, 0, 1]]
    assert read.colour.tolist() == [4, 4]
    assert read.step.tolist() == [0, 1]


def axis_aligned():
    """Yield the 48 signed permutation matrices with their determinants."""
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            yield np.eye(3, dtype=int)[list(order)] * np.array(signs)[:, None]


def test_only_upright_parts_are_read():
    """Of the 24 rotations that keep the axes, the 4 about the vertical are read; the others and all mirrors are not."""
    upright = 0
    for matrix in axis_aligned():
        text = f"1 4 10 -24 10 {' '.join(map(str, matrix.ravel()))} 2357.dat"
        if matrix[1, 1] == 1 and round(np.linalg.det(matrix)) == 1:
            upright += len(read_ldr(text, CATALOGUE))
        else:
            with pytest.raises(BuildError, match="Line 1 is not an upright part"):
                read_ldr(text, CATALOGUE)
    assert upright == 4


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 4 10 -24 10 1 0 0 0 1 0 0 0 1 4070.dat", "Part 4070 is not"),
        ("1 4 12 -24 10 1 0 0 0 1 0 0 0 1 3005.dat", "Line 1: part 3005 lies between the cells"),
        ("1 4 10 -23 10 1 0 0 0 1 0 0 0 1 3005.dat", "Line 1: part 3005 lies between the cells"),
        ("1 4 10.4 -24 10 1 0 0 0 1 0 0 0 1 3005.dat", "10.4 is not a whole number"),
        ("1 4 x -24 10 1 0 0 0 1 0 0 0 1 3005.dat", "Line 1 is not an upright part"),
        ("1 4 nan -24 10 1 0 0 0 1 0 0 0 1 3005.dat", "Line 1 is not an upright part"),
        ("1 4 inf -24 10 1 0 0 0 1 0 0 0 1 3005.dat", "Line 1 is not an upright part"),
        ("1 4 1e12 -24 10 1 0 0 0 1 0 0 0 1 3005.dat", "Line 1 is not an upright part"),
        ("1 4 10", "Line 1 is not an upright part"),
        ("1 16 10 -24 10 1 0 0 0 1 0 0 0 1 3005.dat", "Line 1: colour 16 is not a brick colour"),
        ("1 0x2FF0000 10 -24 10 1 0 0 0 1 0 0 0 1 3005.dat", "Line 1: colour 50266112 is not a brick colour"),
        ("0 title\n2 24 0 0 0 1 0 0", "Line 2 draws geometry"),
        ("0 !LEGORIZE ROLE ROOF PIECE 0", "Line 1 names no known role"),
        ("0 !LEGORIZE ROLE SHELL PIECE 99999", "Line 1 names no known role"),
        ("0 !LEGORIZE ROLE SHELL PIECE -1", "Line 1 names no known role"),
        ("0 FILE a\n1 16 0 0 0 1 0 0 0 1 0 0 0 1 a", "Line 2 puts the model a into itself"),
    ],
)
def test_what_cannot_be_read_is_refused(text, message):
    """Whatever is not an upright part on the grid is named by its line."""
    with pytest.raises(BuildError, match=message):
        read_ldr(text, CATALOGUE)


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
