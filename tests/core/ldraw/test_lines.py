"""Lines of LDraw documents: models, steps, colours, and what is none of these."""

from __future__ import annotations

import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.ldraw.lines import MOST_BYTES, code_of, decoded, parse

BRICK = "1 4 10 -24 10 1 0 0 0 1 0 0 0 1 3005.dat"


def shape(document):
    """Return the items of each model: names, and None where a step ends."""
    return {name: [item and item.name for item in section.items] for name, section in document.sections.items()}


def test_models_and_steps():
    """A document has its models by name in lower case, each with its items and the ends of its steps."""
    call = "1 16 0 0 0 1 0 0 0 1 0 0 0 1 Arm one.LDR"
    text = f"0 FILE Main.ldr\n{BRICK}\n0 STEP\n{call}\n0 ROTSTEP 0 90 0 REL\n0 NOFILE\n"
    document = parse(f"{text}{BRICK}\n0 FILE arm one.ldr\n{BRICK}\n")
    assert document.main == "main.ldr"
    # what stands after the end of a model belongs to none
    assert shape(document) == {"main.ldr": ["3005.dat", None, "arm one.ldr", None], "arm one.ldr": ["3005.dat"]}
    assert not document.broken


def test_a_turned_view_and_a_step_are_one_end():
    """A STEP right after ROTSTEP ends nothing more, whatever comments lie between; one after a part does."""
    turned = f"{BRICK}\n0 ROTSTEP 0 90 0 REL\n0 // seen from behind\n0 STEP\n"
    assert shape(parse(f"{turned}{turned}")) == {"": ["3005.dat", None, "3005.dat", None]}
    assert shape(parse(f"0 STEP\n{turned}0 STEP\n")) == {"": [None, "3005.dat", None, None]}
    assert shape(parse(f"0 ROTSTEP END\n{BRICK}\n0 STEP\n")) == {"": [None, "3005.dat", None]}


def test_what_stands_before_the_first_model():
    """A title before the first model is no model, but parts there are the main one."""
    assert parse(f"0 made by hand\n0 FILE a.ldr\n{BRICK}").main == "a.ldr"
    assert parse(f"{BRICK}\n0 FILE a.ldr\n").main == ""
    assert shape(parse("")) == {"": []}


def test_first_of_two_models_of_a_name_counts():
    """A second model of the same name is ignored."""
    assert shape(parse(f"0 FILE a\n{BRICK}\n0 FILE A\n{BRICK}\n{BRICK}\n")) == {"a": ["3005.dat"]}


@pytest.mark.parametrize(
    "line",
    [
        "1 4 x -24 10 1 0 0 0 1 0 0 0 1 3005.dat",
        "1 4 nan -24 10 1 0 0 0 1 0 0 0 1 3005.dat",
        "1 4 inf -24 10 1 0 0 0 1 0 0 0 1 3005.dat",
        "1 4 1e12 -24 10 1 0 0 0 1 0 0 0 1 3005.dat",
        "1 4 10 -24 10 1 0 0 0 1 0 0 0 nan 3005.dat",
        "1 4 10",
        "1",
        "1 4 10 -24 10 1 0 0 0 1 0 0 0 1",
        "1 red 10 -24 10 1 0 0 0 1 0 0 0 1 3005.dat",
        "1 -1 10 -24 10 1 0 0 0 1 0 0 0 1 3005.dat",
        f"1 {'9' * 9000} 10 -24 10 1 0 0 0 1 0 0 0 1 3005.dat",
        "hello",
        "0 !LEGORIZE ROLE ROOF PIECE 0",
        "0 !LEGORIZE ROLE SHELL PIECE 99999",
        "0 !LEGORIZE ROLE SHELL PIECE -1",
    ],
    ids=lambda line: line[:40],
)
def test_broken_lines_are_noted(line):
    """A line that is not LDraw is noted by its number, and what stands around it is read."""
    document = parse(f"{BRICK}\n{line}\n{BRICK}\n")
    assert document.broken == [2]
    assert shape(document) == {"": ["3005.dat", "3005.dat"]}


def test_geometry_is_counted_and_comments_are_not():
    """Lines and triangles of their own are counted; comments of any kind are nothing."""
    document = parse("0 title\n2 24 0 0 0 1 0 0\n4 16 0 0 0 1 0 0 1 1 0 0 1 0\n0 GHOST 1 4 0\n0\n\n0 !DATA x\n")
    assert document.sections[""].drawn == [2, 3]
    assert not document.broken


@pytest.mark.parametrize(
    ("word", "code"),
    [("4", 4), ("04", 4), ("0x2FF8000", 0x2FF8000), ("0X2ff8000", 0x2FF8000), ("#2FF8000", 0x2FF8000), ("4.5", None)],
)
def test_codes_of_colours(word, code):
    """Decimal, hexadecimal, or with a number sign."""
    assert code_of(word) == code


def test_defined_colours():
    """A document may define colours; definitions that are not well formed are none."""
    text = "0 !COLOUR Mine CODE 900 VALUE #102030 EDGE #000000\n0 !COLOUR Bad CODE 901 VALUE red\n0 !COLOUR\n"
    assert parse(text).colours == {900: (16, 32, 48)}


@pytest.mark.parametrize(
    "data", [b"0 Caf\xc3\xa9", b"\xef\xbb\xbf0 Caf\xc3\xa9", "0 Café".encode("utf-16"), b"0 Caf\xe9"]
)
def test_any_encoding_is_read(data):
    """UTF-8 with or without its mark, UTF-16, and older Windows files."""
    assert decoded(data, "m.ldr") == "0 Café"


def test_what_is_no_text_is_refused():
    """Bytes that are no text, and files that are longer than any model, get a sentence."""
    with pytest.raises(BuildError, match=r"m.ldr is not an LDraw file"):
        decoded(b"PK\x03\x04\0\0", "m.ldr")
    with pytest.raises(BuildError, match=r"m.ldr has 64 MB, more than"):
        decoded(bytes(MOST_BYTES + 1), "m.ldr")
