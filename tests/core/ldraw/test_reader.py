"""Documents as bricks, and what is told of what could not be read."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.errors import BuildError
from legorize_addon.core.files.ldraw import write_ldr
from legorize_addon.core.ldraw.lines import decoded
from legorize_addon.core.ldraw.reader import read_file, read_ldraw
from legorize_addon.core.model import part_images
from legorize_addon.core.model.assembly import Assembly
from tests.core.any_bricks import CATALOGUE, any_bricks, everything, multiset, table

unhurried = settings(deadline=None, max_examples=50)
GOLDEN = Path(__file__).parents[2] / "golden" / "catalogue.ldr"
UPRIGHT = "1 0 0 0 1 0 0 0 1"


def read(text):
    """Return the bricks of a text as (number, corner, turn, colour), and the remarks."""
    found = read_ldraw(text, CATALOGUE)
    bricks = found.bricks
    rows = zip(bricks.part.tolist(), bricks.corner.tolist(), bricks.turn.tolist(), bricks.colour.tolist(), strict=True)
    return [(CATALOGUE.parts[part].number, *rest) for part, *rest in rows], found.remarks


@unhurried
@given(any_bricks())
def test_read_gives_back_the_bricks(bricks):
    """Part, place, turn up to symmetry, colour, role, piece and step survive writing and reading."""
    found = read_ldraw(write_ldr(Assembly(bricks, CATALOGUE), name="m.ldr", title="m"), CATALOGUE)
    assert multiset(found.bricks) == multiset(bricks)
    assert not found.remarks


def test_golden_file_reads_as_the_catalogue_model():
    """The file on record reads back to every part in each of its orientations."""
    assert multiset(read_ldraw(GOLDEN.read_text(encoding="utf-8"), CATALOGUE).bricks) == multiset(everything())


def test_nothing_is_read_of_nothing():
    """No lines, no bricks."""
    assert read("") == ([], ())
    assert read("0 STEP\n0 FILE a\n") == ([], ())


def test_sub_model_is_turned_moved_and_coloured_by_its_call():
    """A sub-model's brick is turned with it, moved with it, and takes its colour where it has none of its own."""
    text = f"""0 FILE main.ldr
1 14 100 -24 40 0 0 -1 0 1 0 1 0 0 arm.ldr
0 FILE Arm.ldr
1 16 40 -24 20 {UPRIGHT} 3001.dat
1 4 90 -8 30 {UPRIGHT} 3024.dat
"""
    # the brick's centre (40, 20) comes to (100 - 20, 40 + 40), the plate's (90, 30) to (100 - 30, 40 + 90)
    assert read(text)[0] == [("3001", [3, 2, 3], 1, 14), ("3024", [3, 6, 3], 0, 4)]


def test_files_of_other_programs_can_be_read():
    """Decimal points, capitals, aliases, folders, tabs and comments are understood; steps end at turns, too."""
    text = "0 by hand\n1\t4 20.0004 -8.000 10 1 0 0 0 1.00 0 -0.0 0 1 3023B.DAT\n0 ROTSTEP 30 20 0\n"
    text += f"1 0x4 10 -32 10 {UPRIGHT} parts\\3005.dat"
    found = read_ldraw(text, CATALOGUE)
    assert read(text)[0] == [("3023", [0, 0, 0], 0, 4), ("3005", [0, 0, 1], 0, 4)]
    assert found.bricks.step.tolist() == [0, 1]
    assert found.has_steps
    assert not read_ldraw(f"1 4 10 -24 10 {UPRIGHT} 3005.dat\n0 STEP", CATALOGUE).has_steps


def test_unknown_parts_are_counted_by_number():
    """What the catalogue does not have is left out, and told by number, most frequent first."""
    numbers = ["4070", "87087", "4070", *map(str, range(9000, 9008))]
    lines = [f"1 4 0 0 0 {UPRIGHT} {number}.dat" for number in numbers]
    bricks, remarks = read("\n".join([*lines, f"1 4 10 -24 10 {UPRIGHT} 3005.dat"]))
    assert len(bricks) == 1
    assert remarks == (
        "11 parts are not in the catalogue, left out: 2 x 4070, 1 x 87087, 1 x 9000, 1 x 9001, 1 x 9002, 1 x 9003, "
        "1 x 9004, 1 x 9005 and 2 more kinds.",
    )


@pytest.mark.parametrize(
    ("line", "remark", "stays"),
    [
        ("1 4 30 -24 10 1 0 0 0 -1 0 0 0 -1 3005.dat", "1 part does not stand upright, left out (line 2).", False),
        (f"1 4 35 -24 20 {UPRIGHT} 3005.dat", "1 part lies between the cells of the grid, left out (line 2).", False),
        (
            "1 4 30 -24 10 -1 0 0 0 1 0 0 0 1 3005.dat",
            "1 part is mirrored, read as the same part unmirrored (line 2).",
            True,
        ),
        (f"1 4 30 -24 nan {UPRIGHT} 3005.dat", "Line 2 is not LDraw, left out.", False),
        ("3 4 0 0 0 1 0 0 0 1 0", "1 line draws geometry that is no part, left out.", False),
        ("1 4 0 0 0 1e6 0 0 0 1e6 0 0 0 1e6 3005.dat", "1 part does not stand upright, left out (line 2).", False),
        (
            f"1 4 0 0 0 {UPRIGHT} \x1b[31m{'a' * 99}.dat",
            "1 part is not in the catalogue, left out: 1 x [31m" + 35 * "a" + "\u2026.",
            False,
        ),
        (f"1 16 30 -24 10 {UPRIGHT} 3005.dat", "1 part has no colour, read as Light Bluish Gray.", True),
        (f"1 99 30 -24 10 {UPRIGHT} 3005.dat", "1 part has the unknown colour 99, read as Light Bluish Gray.", True),
        (
            f"1 0x2F4F4F4 30 -24 10 {UPRIGHT} 3005.dat",
            "Colours that the catalogue does not have were read as the closest ones: #F4F4F4 as White (1).",
            True,
        ),
    ],
)
def test_what_is_changed_or_left_out_is_told(line, remark, stays):
    """One line that is not as ours are, below one that is: a sentence says what became of it."""
    bricks, remarks = read(f"1 4 10 -24 10 {UPRIGHT} 3005.dat\n{line}\n")
    assert len(bricks) == 1 + stays
    assert remarks == (remark,)


def test_parts_at_the_end_of_the_world_are_left_out():
    """Five thousand calls that each go on by four kilometres lead to numbers that no cell has."""
    calls = "".join(f"0 FILE m{row}\n1 16 9999980 0 0 {UPRIGHT} m{row + 1}\n" for row in range(5000))
    bricks, remarks = read(f"{calls}0 FILE m5000\n1 4 0 0 0 {UPRIGHT} 3005.dat\n")
    assert bricks == []
    assert remarks == ("1 part lies more than 4 km away, left out (line 10002).",)


def test_models_beside_the_file_are_found(tmp_path):
    """A sub-model may be a file in the same folder, which may call others; nothing outside of it is opened."""
    folder, brick = tmp_path / "sub", f"1 16 10 -24 10 {UPRIGHT} 3005.dat\n"
    folder.mkdir()
    call = f"1 4 0 0 0 {UPRIGHT} "
    (folder / "main.ldr").write_text(f"{call}Wing.ldr\n{call}../secret.ldr\n{call}gone.ldr\n")
    (folder / "wing.LDR").write_text(f"0 FILE a.ldr\n{call}b.ldr\n1 16 0 0 0 {UPRIGHT} tip.ldr\n")
    (folder / "tip.ldr").write_text(brick)
    (tmp_path / "secret.ldr").write_text(brick)
    found = read_file(folder / "main.ldr", CATALOGUE)
    assert found.bricks.colour.tolist() == [4]
    assert found.left_out == {"secret.ldr": 1, "gone.ldr": 1, "b.ldr": 1}


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "m.ldr has no brick that can be read"),
        (b"hello world\n", "no brick that can be read.* Line 1 is not LDraw"),
        (b"\x89PNG\r\n\x1a\n\0\0", "is not an LDraw file"),
        (f"1 4 0 0 0 {UPRIGHT} 4070.dat".encode(), "1 part is not in the catalogue, left out: 1 x 4070"),
        (f"0 FILE a\n1 16 0 0 0 {UPRIGHT} a".encode(), "puts the model a into itself"),
    ],
)
def test_files_without_bricks_are_refused(data, message, tmp_path):
    """A file of which nothing can be read gets one sentence with the reason."""
    (tmp_path / "m.ldr").write_bytes(data)
    with pytest.raises(BuildError, match=message):
        read_file(tmp_path / "m.ldr", CATALOGUE)


def test_missing_file_is_refused(tmp_path):
    """There must be a file."""
    with pytest.raises(BuildError, match="cannot be read"):
        read_file(tmp_path / "m.ldr", CATALOGUE)


WORDS = ["0", "1", "2", "4", "16", "-8", "20", "nan", "inf", "1e99", "0x2FF0000", "FILE", "NOFILE", "STEP", "ROTSTEP"]
WORDS += ["a.ldr", "b.ldr", "3001.dat", "2357.DAT", "3867.dat", "!COLOUR", "CODE", "VALUE", "#1", "!LEGORIZE", "ROLE"]
lines = st.lists(st.sampled_from(WORDS), max_size=16).map(" ".join)
parts = st.tuples(
    st.sampled_from(WORDS), st.lists(st.sampled_from(WORDS), min_size=12, max_size=12), st.sampled_from(WORDS)
).map(lambda words: f"1 {words[0]} {' '.join(words[1])} {words[2]}")


def attempt(data):
    """Return what is read of a text or of bytes, or None and the sentence of the refusal."""
    try:
        return read_ldraw(data if isinstance(data, str) else decoded(data, "m.ldr"), CATALOGUE), ""
    except BuildError as error:
        return None, str(error)


@unhurried
@given(st.lists(st.one_of(lines, parts, st.just("0 FILE a.ldr"), st.just("0 FILE b.ldr")), max_size=12))
def test_hostile_text_is_read_or_refused(text):
    """Whatever words stand in a document, it is read, or refused in one sentence; what is read can be written."""
    found, sentence = attempt("\n".join(text))
    if found is None:
        assert sentence.endswith(".")
        return
    assert all(remark.endswith(".") for remark in found.remarks)
    assert len(found.line) == len(found.bricks)
    write_ldr(Assembly(found.bricks, CATALOGUE), name="m.ldr", title="m")


@unhurried
@given(st.binary(max_size=300))
def test_hostile_bytes_are_read_or_refused(data):
    """Any bytes are text of some kind, or refused in one sentence."""
    found, sentence = attempt(data)
    assert found is not None or sentence.endswith(".")


@pytest.mark.parametrize("turn", range(4))
def test_slopes_in_a_mirror_fall_the_same_way(turn):
    """A slope is its own image across its width: with that axis mirrored it is read at the same turn."""
    row = CATALOGUE.part_row("3040b")
    text = write_ldr(Assembly(table([(row, 3, 2, 0, turn, 4, 0, 0, 0)]), CATALOGUE), name="m.ldr", title="m")
    [line] = [line for line in text.splitlines() if line.startswith("1 ")]
    words = line.split()
    # the first column of the matrix is where LDraw's x goes
    for place in (5, 8, 11):
        words[place] = str(-int(words[place]))
    bricks, _ = read(" ".join(words))
    assert bricks == read(line)[0] == [("3040b", [3, 2, 0], turn, 4)]
    assert not read(line)[1]


def test_mirrored_wedge_plates_read_as_their_images():
    """A left wedge plate in a mirror is a right one, one with a cut corner another turn of itself; nothing is lost."""
    left, right, corner = (CATALOGUE.part_row(number) for number in ("41770", "41769", "26601"))
    for turn in range(4):
        for part, image in ((left, right), (corner, corner)):
            bricks = table([(part, 0, 0, 0, turn, 4, 0, 0, 0)])
            text = write_ldr(Assembly(bricks, CATALOGUE), name="m.ldr", title="m")
            words = next(line for line in text.split("\r\n") if line.startswith("1 ")).split()
            matrix = np.array(words[5:14], np.float64).reshape(3, 3) @ np.diag((-1, 1, 1))
            line = " ".join([*words[:5], *(f"{entry:g}" for entry in matrix.reshape(-1)), words[14]])
            found = read_ldraw(line, CATALOGUE)
            assert found.bricks.part.tolist() == [image]
            assert found.remarks == ()
            # what is mirrored in the part's own frame is mirrored along x or y in the model
            expected = part_images(CATALOGUE.parts, 1 - turn % 2)[part, turn]
            assert [image, found.bricks.turn[0]] == expected.tolist()
