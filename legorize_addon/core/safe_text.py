"""Names that users chose (of models and files), made safe for programs: never a command, never a formula.

References
----------
LDraw.org, "LDraw File Format Specification": a line of type 0 is a META command
if its second word is a keyword that the reader knows, else a comment; official
META commands begin with an exclamation mark, older ones are plain words. The
words below are those of the specification and its extensions (MPD, BFC, header,
colours) and the unofficial ones of MLCad, LPub, L3P, LSynth and LDView.
OWASP, "CSV Injection": what spreadsheets take for the start of a formula.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from typing import Final

META: Final = frozenset((
    "STEP", "PAUSE", "WRITE", "PRINT", "CLEAR", "SAVE", "FILE", "NOFILE", "DATA", "BFC", "ROTSTEP", "ROTATION",
    "COLOR", "COLOUR", "NAME", "AUTHOR", "LICENSE", "LICENCE", "LDRAW_ORG", "CATEGORY", "KEYWORDS", "HELP",
    "HISTORY", "CMDLINE", "THEME", "PREVIEW", "TEXMAP", "AVATAR", "UNOFFICIAL", "OFFICIAL", "ORIGINAL", "MOVED",
    "GHOST", "BUFEXCHG", "BACKGROUND", "GROUP", "MLCAD", "LPUB", "PLIST", "L3P", "IFNDEF", "IFDEF", "ENDIF",
    "SYNTH", "LSYNTH", "LDVIEW", "LDCAD", "LEOCAD", "LTRAX", "PE_TEX_PATH", "PE_TEX_INFO", "LEGORIZE", "CERTIFY",
    "CCW", "CW", "INVERTNEXT", "WINDING",
))  # fmt: skip
"""Words that a reader may take for a command at the beginning of a line, whatever follows."""

FORMULA: Final = ("=", "+", "-", "@", "\t", "\r", "\n", "\uff1d", "\uff0b", "\uff0d", "\uff20")
"""How a cell begins that a spreadsheet would compute, full-width signs included."""

UNTITLED: Final = "Untitled"


def one_line(text: str) -> str:
    """Return a text in one line that can be printed: without controls, line ends and halves of characters.

    Parameters
    ----------
    text : str
        Whatever a user or a file system gave as a name.

    Returns
    -------
    str
        Its words, joined by single spaces; "Untitled" if none is left.
    """
    return " ".join("".join(letter if letter.isprintable() else " " for letter in text).split()) or UNTITLED


def title_line(text: str) -> str:
    """Return a title that can follow the 0 of an LDraw comment.

    Parameters
    ----------
    text : str
        What the model is called.

    Returns
    -------
    str
        The text in one line. "Model" stands before it if its first word could
        be a command: a known keyword in any case, or a word that begins with
        neither a letter nor a digit.
    """
    line = one_line(text)
    first = line.split()[0]
    command = not first[0].isalnum() or first.strip(":,;.").upper() in META
    return f"Model {line}" if command else line


def csv_text(columns: Sequence[str], rows: Iterable[Sequence[object]], *, line_end: str = "\n") -> str:
    """Return a table as CSV in which no cell is a formula.

    Parameters
    ----------
    columns : sequence of str
        The first row.
    rows : iterable of sequence
        Texts and numbers. A text that a spreadsheet would take for a formula
        gets an apostrophe before it; numbers stay as they are.
    line_end : str, optional
        Of every row.

    Returns
    -------
    str
        To be written without translating line ends.
    """
    text = io.StringIO(newline="")
    table = csv.writer(text, lineterminator=line_end)
    table.writerow(columns)
    table.writerows([[_harmless(cell) for cell in row] for row in rows])
    return text.getvalue()


def _harmless(cell: object) -> object:
    return f"'{cell}" if isinstance(cell, str) and cell.startswith(FORMULA) else cell
