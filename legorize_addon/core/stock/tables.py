"""Tables of parts that other programs wrote, as rows of named cells: CSV with any separator, and BrickLink's XML.

References
----------
BrickLink help, "Upload XML": an inventory is an ``INVENTORY`` of ``ITEM`` with ``ITEMID``, ``COLOR``, ``QTY`` (or
``MINQTY``) and ``PRICE``. BrickStore's .bsx files have the same in ``Inventory/Item`` with ``ItemID`` and ``ColorID``.
"""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Final
from xml.etree import ElementTree

from ..errors import SettingsError

LARGEST: Final = 64 << 20
"""Bytes above which a file is no list of parts: all lots of a large shop are a tenth of it."""

_SEPARATORS: Final = "\t;,|"

Row = dict[str, str]
"""Cells by the name of their column, in lower case, of letters and digits alone."""


def read_table(path: str, setting: str) -> list[Row]:
    """Read a table.

    Parameters
    ----------
    path : str
        The file.
    setting : str
        Name of the setting that names it, for errors.

    Returns
    -------
    list of Row
        At least one.

    Raises
    ------
    SettingsError
        It cannot be opened, is no text, is damaged, or has no rows.
    """
    text = _text(path, setting)
    rows = _items(text, path, setting) if text.lstrip().startswith("<") else _lines(text)
    if not rows:
        raise SettingsError(
            f"{setting} is {path!r}, which has no rows: give a CSV file with names of columns, or BrickLink's XML."
        )
    return rows


def column(row: Row, names: tuple[str, ...]) -> str | None:
    """Return the first of some columns that the rows have."""
    return next((name for name in names if name in row), None)


def _text(path: str, setting: str) -> str:
    """Return the text of a file, whatever its encoding."""
    try:
        file = Path(path)
        # opening a pipe would wait for a writer
        if file.exists() and not file.is_file():
            raise SettingsError(f"{setting} is {path!r}, which is no file: give a CSV file or BrickLink's XML.")
        if file.stat().st_size > LARGEST:
            raise SettingsError(f"{setting} is {path!r}, which has more than {LARGEST >> 20} MB: give a list of parts.")
        data = file.read_bytes()
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else error
        raise SettingsError(
            f"{setting} is {path!r}, which cannot be opened ({reason}): choose another file, or leave {setting} empty."
        ) from error
    # spreadsheets of Western Europe still write cp1252
    encodings = ("utf-16",) if data.startswith((b"\xff\xfe", b"\xfe\xff")) else ("utf-8-sig", "cp1252")
    for encoding in encodings:
        try:
            text = data.decode(encoding)
        except UnicodeDecodeError:
            continue
        if "\0" not in text:
            return text
    raise SettingsError(f"{setting} is {path!r}, which is no text file: give a CSV file or BrickLink's XML.")


def _lines(text: str) -> list[Row]:
    """Return the rows of a CSV file: the separator is the one that divides the first line into most cells."""
    lines = text.splitlines()
    first = next((number for number, line in enumerate(lines) if line.strip(_SEPARATORS + " ")), len(lines))
    lines = lines[first:]
    if not lines:
        return []
    separator = max(_SEPARATORS, key=lambda each: len(next(csv.reader(lines[:1], delimiter=each))))
    cells = csv.reader(lines, delimiter=separator)
    names = [_plain(name) for name in next(cells)]
    return [dict(zip(names, (cell.strip() for cell in row), strict=False)) for row in cells if any(map(str.strip, row))]


def _items(text: str, path: str, setting: str) -> list[Row]:
    """Return the items of an XML file."""
    damaged = f"{setting} is {path!r}, which is damaged or no list of parts"
    if "<!DOCTYPE" in text and "<!ENTITY" in text:
        raise SettingsError(f"{damaged} (it defines entities): export it again.")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise SettingsError(f"{damaged} ({error}): export it again.") from error
    currency = next(
        (value for element in root.iter() for name, value in element.items() if _plain(name) == "currency"), ""
    )
    rows = [
        {_plain(cell.tag): (cell.text or "").strip() for cell in item}
        for item in root.iter()
        if _plain(item.tag) == "item"
    ]
    return [{**({"currency": currency} if currency else {}), **row} for row in rows if row]


def _plain(name: str) -> str:
    """Return the letters and digits of a name in lower case: "Color ID", "color_id" and "ColorID" are one."""
    return "".join(letter for letter in name.casefold() if letter.isalnum())
