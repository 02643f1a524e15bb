"""How wide texts are in the fonts that every reader of PDF has.

References
----------
Adobe Core 14 AFM files, "Helvetica" and "Helvetica-Bold": advance widths in thousandths of the size.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final
from unicodedata import normalize

_FIRST: Final = " !\"#$%&'()*+,-./0123456789:;<=>?@ABCDEFGHIJKLMNOPQRSTUVWXYZ[\\]^_`abcdefghijklmnopqrstuvwxyz{|}~"
_PLAIN: Final = (
    "278 278 355 556 556 889 667 191 333 333 389 584 278 333 278 278 556 556 556 556 556 556 556 556 556 556 278 278 "
    "584 584 584 556 1015 667 667 722 722 667 611 778 722 278 500 667 556 833 722 778 667 778 722 667 611 722 667 944 "
    "667 667 611 278 278 278 469 556 333 556 556 500 556 556 278 556 556 222 222 500 222 833 556 556 556 556 333 500 "
    "278 556 500 722 500 500 500 334 260 334 584"
)
_BOLD: Final = (
    "278 333 474 556 556 889 722 238 333 333 389 584 278 333 278 278 556 556 556 556 556 556 556 556 556 556 333 333 "
    "584 584 584 611 975 722 722 722 722 667 611 778 722 278 556 722 611 833 722 778 667 778 722 667 611 722 667 944 "
    "667 667 611 333 278 333 584 556 333 556 611 556 611 556 333 611 611 278 278 556 278 889 611 611 611 611 389 556 "
    "333 611 556 778 556 556 500 389 280 389 584"
)
_OTHER: Final = 584
"""Width of what the tables do not have; that of the signs for times and plus or minus."""


def _table(widths: str) -> Mapping[str, int]:
    return MappingProxyType(dict(zip(_FIRST, map(int, widths.split()), strict=True)))


_WIDTHS: Final = {False: _table(_PLAIN), True: _table(_BOLD)}


def width(text: str, size: float, *, bold: bool = False) -> float:
    """Return how wide a text is, in the unit of its size; letters with accents are as wide as those without."""
    table = _WIDTHS[bold]
    return sum(table.get(normalize("NFKD", letter)[:1], _OTHER) for letter in text) * size / 1000


def shortened(text: str, size: float, room: float, *, bold: bool = False) -> str:
    """Return a text, or as many of its first letters as there is room for, with three dots behind them."""
    if width(text, size, bold=bold) <= room:
        return text
    while text and width(f"{text}...", size, bold=bold) > room:
        text = text[:-1]
    return f"{text.rstrip()}..."


def wrapped(text: str, size: float, room: float, *, bold: bool = False) -> list[str]:
    """Return the lines into which a text breaks at its blanks; a word that is too long has a line of its own."""
    found: list[str] = []
    for word in text.split():
        longer = f"{found[-1]} {word}" if found else word
        if found and width(longer, size, bold=bold) <= room:
            found[-1] = longer
        else:
            found.append(word)
    return found


def in_fonts(text: str) -> bool:
    """Tell whether these fonts have all letters of a text."""
    return len(text.encode("cp1252", "ignore")) == len(text)


def western(text: str) -> str:
    """Return a text in letters of these fonts: without accents where that helps, else as their numbers in Unicode."""
    letters = []
    for letter in text:
        plain = letter if in_fonts(letter) else normalize("NFKD", letter)[:1]
        letters.append(plain if in_fonts(plain) else f"[U+{ord(letter):04X}]")
    return "".join(letters)
