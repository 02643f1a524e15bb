"""Tables of other programs: any separator and encoding, and one sentence for what is none."""

from __future__ import annotations

import os

import pytest

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.stock.tables import column, read_table

ROWS = [{"part": "3001", "colorid": "5"}, {"part": "3002", "colorid": "6"}]


@pytest.mark.parametrize("separator", [",", ";", "\t", "|"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_any_separator_and_encoding(tmp_path, separator, encoding):
    """Names of columns lose everything but letters and digits; empty lines do not count."""
    lines = [
        "",
        separator.join(("Part", "Color ID")),
        separator.join(("3001", " 5 ")),
        "",
        separator.join(("3002", "6")),
    ]
    (tmp_path / "a.csv").write_bytes("\r\n".join(lines).encode(encoding))
    assert read_table(str(tmp_path / "a.csv"), "owned") == ROWS


def test_cells_in_quotes(tmp_path):
    """A separator inside quotes separates nothing."""
    (tmp_path / "a.csv").write_text('Part,Name,Price\n3001,"Brick, 2 x 4","0,05"\n')
    assert read_table(str(tmp_path / "a.csv"), "prices") == [{"part": "3001", "name": "Brick, 2 x 4", "price": "0,05"}]


@pytest.mark.parametrize("head", ["", '<?xml version="1.0" encoding="UTF-8"?>'])
def test_xml_of_bricklink_and_of_brickstore(tmp_path, head):
    """Items are rows, whatever the letters of the tags; the currency of the inventory goes to all of them."""
    items = "<ITEM><ITEMID>3001</ITEMID><COLOR>5</COLOR></ITEM>"
    (tmp_path / "a.xml").write_text(f"{head}<INVENTORY>{items}</INVENTORY>")
    assert read_table(str(tmp_path / "a.xml"), "owned") == [{"itemid": "3001", "color": "5"}]
    (tmp_path / "b.bsx").write_text(
        f'{head}<BrickStoreXML><Inventory Currency="EUR"><Item><ItemID>3001</ItemID><ColorID>5</ColorID></Item>'
        "</Inventory></BrickStoreXML>"
    )
    assert read_table(str(tmp_path / "b.bsx"), "owned") == [{"currency": "EUR", "itemid": "3001", "colorid": "5"}]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "has no rows"),
        (b"part,colour\n", "has no rows"),
        (b"\0\1\2\3", "no text file"),
        (b"<INVENTORY><ITEM>", "damaged"),
        (b"<INVENTORY></INVENTORY>", "has no rows"),
        (b'<!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>', "defines entities"),
    ],
)
def test_what_is_no_table_gets_a_sentence(tmp_path, content, words):
    """It names the setting and the file, says what is wrong and what to do."""
    path = tmp_path / "a.csv"
    path.write_bytes(content)
    with pytest.raises(SettingsError, match=words) as refused:
        read_table(str(path), "prices")
    assert str(refused.value).startswith(f"prices is {str(path)!r}, which ")
    assert str(refused.value).endswith(".")


def test_what_cannot_be_opened_gets_a_sentence(tmp_path):
    """A file that is not there, a folder, a pipe, and a name that no file can have."""
    os.mkfifo(tmp_path / "pipe")
    for name in ("gone.csv", ".", "pipe", "a\0b"):
        with pytest.raises(SettingsError, match=r"^owned is .*\.$"):
            read_table(str(tmp_path / name), "owned")


def test_first_of_the_columns_there():
    """Names count in the order in which they are asked for."""
    assert column({"a": "", "b": ""}, ("c", "b", "a")) == "b"
    assert column({"a": ""}, ("c",)) is None
