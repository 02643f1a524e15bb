"""Pages as PDF, in vectors, with the fonts that every reader has."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from io import BytesIO
from itertools import pairwise
from typing import Final

import pydyf

from .canvas import Group, Item, Page, Path, Rgb, Text
from .fonts import western, width
from .svg import number

POINTS_PER_MM: Final = 72 / 25.4

_ROUND: Final = b"1 J 1 j"
"""Ends and corners of lines."""


class Document:
    """A PDF that grows page by page, so that no page need be kept.

    Parameters
    ----------
    title : str
        Of the document, for the reader's window.
    """

    def __init__(self, title: str) -> None:
        self._pdf = pydyf.PDF()
        self._pdf.info["Title"] = pydyf.String(title)
        fonts = {}
        for name, font in (("P", "Helvetica"), ("B", "Helvetica-Bold")):
            entry = pydyf.Dictionary(
                {"Type": "/Font", "Subtype": "/Type1", "BaseFont": f"/{font}", "Encoding": "/WinAnsiEncoding"}
            )
            self._pdf.add_object(entry)
            fonts[name] = entry.reference
        self._resources = pydyf.Dictionary({"Font": pydyf.Dictionary(fonts)})
        self._marks: list[tuple[str, pydyf.Dictionary]] = []

    def add(self, page: Page, content: bytes | None = None) -> None:
        """Add a page; of one that :func:`content_of` has drawn before, the items are not looked at."""
        wide, high = (length * POINTS_PER_MM for length in (page.width, page.height))
        drawn = pydyf.Stream([content_of(page) if content is None else content], compress=True)
        self._pdf.add_object(drawn)
        entry = pydyf.Dictionary(
            {
                "Type": "/Page",
                "Parent": self._pdf.pages.reference,
                "MediaBox": pydyf.Array([0, 0, round(wide, 3), round(high, 3)]),
                "Resources": self._resources,
                "Contents": drawn.reference,
            }
        )
        self._pdf.add_page(entry)
        if page.title:
            self._marks.append((page.title, entry))

    def data(self) -> bytes:
        """Return the whole file."""
        self._add_bookmarks()
        out = BytesIO()
        self._pdf.write(out, compress=True)
        return out.getvalue()

    def _add_bookmarks(self) -> None:
        if not self._marks:
            return
        root = pydyf.Dictionary({"Type": "/Outlines", "Count": len(self._marks)})
        self._pdf.add_object(root)
        entries = []
        for title, page in self._marks:
            target = pydyf.Array([page.reference, "/Fit"])
            entry = pydyf.Dictionary({"Title": pydyf.String(title), "Parent": root.reference, "Dest": target})
            self._pdf.add_object(entry)
            entries.append(entry)
        for before, after in pairwise(entries):
            before["Next"], after["Prev"] = after.reference, before.reference
        root["First"], root["Last"] = entries[0].reference, entries[-1].reference
        self._pdf.catalog["Outlines"] = root.reference


def content_of(page: Page) -> bytes:
    """Return what draws a page."""
    start = f"{POINTS_PER_MM:.6f} 0 0 {-POINTS_PER_MM:.6f} 0 {page.height * POINTS_PER_MM:.3f} cm".encode()
    return b"\n".join([start, _ROUND, *_written(page.items)])


def _written(items: Sequence[Item]) -> Iterator[bytes]:
    for item in items:
        if isinstance(item, Group):
            yield b"q"
            yield f"{' '.join(f'{value:.6g}' for value in item.matrix)} cm".encode()
            if item.clip is not None:
                yield data(item.clip)
                yield b"W n"
            yield from _written(item.items)
            yield b"Q"
        elif isinstance(item, Path):
            yield from _painted(item)
        else:
            yield _text(item)


def _painted(path: Path) -> Iterator[bytes]:
    if not len(path.points):
        return
    corners = data(path)
    for paint in path.paints:
        parts = []
        if paint.fill is not None:
            parts.append(f"{_colour(paint.fill)} rg")
        if paint.stroke is not None:
            parts.append(f"{_colour(paint.stroke)} RG {number(paint.width)} w")
        parts.append(f"[{' '.join(map(number, paint.dash))}] 0 d")
        yield " ".join(parts).encode()
        yield corners
        yield b"B" if paint.fill is not None and paint.stroke is not None else b"f" if paint.stroke is None else b"S"


def data(path: Path) -> bytes:
    """Return the corners of a path as PDF operators."""
    whole = path.points.dtype.kind != "f"
    texts = [f"{x} {y}" if whole else f"{number(x)} {number(y)}" for x, y in path.points.tolist()]
    parts, row = [], 0
    for count in path.count.tolist():
        parts.append(f"{texts[row]} m")
        parts += [f"{text} l" for text in texts[row + 1 : row + count]]
        if path.closed:
            parts.append("h")
        row += count
    return "\n".join(parts).encode()


def _colour(rgb: Rgb) -> str:
    return " ".join(number(value / 255) for value in rgb)


def _text(text: Text) -> bytes:
    shown = western(text.text)
    back = {"start": 0.0, "middle": 0.5, "end": 1.0}[text.anchor] * width(shown, text.size, bold=text.bold)
    letters = shown.encode("cp1252", "replace").hex()
    font = "B" if text.bold else "P"
    place = f"1 0 0 -1 {number(text.x - back)} {number(text.y)} Tm"
    return f"BT {_colour(text.colour)} rg /{font} {number(text.size)} Tf {place} <{letters}> Tj ET".encode()
