"""Pages as SVG."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from .canvas import Group, Item, Page, Paint, Path, Rgb, Text

FONTS: Final = "Helvetica,Arial,Liberation Sans,sans-serif"


def svg(page: Page, *, name: str = "p") -> str:
    """Write a page as an SVG element.

    Parameters
    ----------
    page : Page
    name : str
        First letters of the names of its parts, which must differ between pages of one document.

    Returns
    -------
    str
        An element with a size in mm, without an XML declaration.
    """
    width, height = number(page.width), number(page.height)
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}mm" height="{height}mm" '
        f'viewBox="0 0 {width} {height}" font-family="{FONTS}" fill="none" '
        'stroke-linecap="round" stroke-linejoin="round">'
    )
    return "".join([head, *_Writer(name).written(page.items), "</svg>"])


def number(value: float) -> str:
    """Return a number with at most three decimals, as short as it can be."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return {"-0": "0", "": "0"}.get(text, text)


class _Writer:
    def __init__(self, name: str) -> None:
        self._name, self._n = name, 0

    def written(self, items: Sequence[Item]) -> Iterator[str]:
        """Yield the lines of items."""
        for item in items:
            if isinstance(item, Group):
                yield from self._group(item)
            elif isinstance(item, Path):
                yield from self._path(item)
            else:
                yield _text(item)

    def _next(self) -> str:
        self._n += 1
        return f"{self._name}{self._n}"

    def _group(self, group: Group) -> Iterator[str]:
        clip = ""
        if group.clip is not None:
            name = self._next()
            yield f'<clipPath id="{name}"><path d="{data(group.clip)}"/></clipPath>'
            clip = f' clip-path="url(#{name})"'
        matrix = group.matrix
        values = " ".join(number(each) if abs(each) >= 1 else f"{each:.6g}" for each in matrix)
        # a clip is in the units of the group that names it
        if matrix == (1.0, 0.0, 0.0, 1.0, 0.0, 0.0):
            yield f"<g{clip}>"
        else:
            yield f'<g transform="matrix({values})"{clip}>'
        yield from self.written(group.items)
        yield "</g>"

    def _path(self, path: Path) -> Iterator[str]:
        if not len(path.points):
            return
        if len(path.paints) == 1:
            yield f'<path{_style(path.paints[0])} d="{data(path)}"/>'
            return
        name = self._next()
        first, *others = path.paints
        # the first one is drawn inside a group, as what <use> repeats brings its own style along
        yield f'<g{_style(first)}><path id="{name}" d="{data(path)}"/></g>'
        for paint in others:
            yield f'<use href="#{name}"{_style(paint)}/>'


def data(path: Path) -> str:
    """Return the corners of a path as SVG path data, relative after the first point of each line."""
    if path.points.dtype.kind == "f":
        return _by_number(path)
    points = path.points
    steps = np.diff(points, axis=0, prepend=np.zeros((1, 2), dtype=points.dtype))
    texts = steps.astype(str)
    # a minus parts two numbers by itself
    gap = np.where(steps[:, 1] < 0, "", " ")
    pairs = np.char.add(np.char.add(texts[:, 0], gap), texts[:, 1])
    starts = np.cumsum(path.count) - path.count
    letter = np.full(len(points), "l")
    letter[starts] = "m"
    # the first step of a line begins where the line before it ended, or began if it was closed
    if path.closed:
        back = points[starts] - np.concatenate([np.zeros((1, 2), dtype=points.dtype), points[starts[:-1]]])
        pairs = pairs.astype(object)
        pairs[starts] = [f"{x}{'' if y < 0 else ' '}{y}" for x, y in back.tolist()]
        letter = letter.astype(object)
        letter[starts[1:]] = "zm"
    end = "z" if path.closed else ""
    return "".join(np.stack([letter, pairs], axis=1).astype(object).ravel().tolist()) + end


def _by_number(path: Path) -> str:
    parts, row = [], 0
    for count in path.count.tolist():
        points = path.points[row : row + count].tolist()
        parts.append("M" + "L".join(f"{number(x)} {number(y)}" for x, y in points) + ("Z" if path.closed else ""))
        row += count
    return "".join(parts)


def colour(rgb: Rgb) -> str:
    """Return a colour as hexadecimal number, in three digits where they say all."""
    text = bytes(rgb).hex()
    return f"#{text[::2]}" if text[::2] == text[1::2] else f"#{text}"


def _style(paint: Paint) -> str:
    parts = []
    if paint.fill is not None:
        parts.append(f' fill="{colour(paint.fill)}"')
    if paint.stroke is not None:
        parts.append(f' stroke="{colour(paint.stroke)}" stroke-width="{number(paint.width)}"')
    if paint.dash:
        parts.append(f' stroke-dasharray="{" ".join(map(number, paint.dash))}"')
    return "".join(parts)


def _text(text: Text) -> str:
    parts = [f'<text x="{number(text.x)}" y="{number(text.y)}" font-size="{number(text.size)}"']
    parts.append(f' fill="{colour(text.colour)}"')
    if text.bold:
        parts.append(' font-weight="bold"')
    if text.anchor != "start":
        parts.append(f" text-anchor={quoteattr(text.anchor)}")
    return "".join([*parts, f">{escape(text.text)}</text>"])
