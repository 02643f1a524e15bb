"""The name of a model, in letters that the fonts of every PDF reader have, or else as outlines."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from ..arrays import Floats, Ints
from .canvas import BLACK, Item, Paint, Path, Rgb, Text, moved
from .fonts import in_fonts, shortened
from .fonts import width as text_width


@dataclass(frozen=True, slots=True, eq=False)
class Lettering:
    """Outlines of a line of text.

    Attributes
    ----------
    points : (n, 2) float64 array
        Corners of all outlines, y downwards from the base line, in sizes of the letters.
    count : (k,) int64 array
        Corners of each outline; those of holes run the other way round.
    width : float
        Of the line.
    missing : str
        Letters that are shown as boxes, as the font has none for them.
    """

    points: Floats
    count: Ints
    width: float
    missing: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Title:
    """The name of a model.

    Attributes
    ----------
    text : str
    outlines : Lettering or None
        How it is drawn where the fonts do not have all of its letters; without it, those are replaced.
    """

    text: str
    outlines: Lettering | None = None

    @property
    def fits(self) -> bool:
        """Whether the fonts have all of its letters."""
        return in_fonts(self.text)

    @property
    def lost(self) -> str:
        """A sentence on letters that cannot be drawn, empty if there are none."""
        missing = self.outlines.missing if self.outlines and not self.fits else ""
        if not missing:
            return ""
        letters = " ".join(missing)
        return f"No font has the letters {letters} of the name {self.text!r}: the booklet shows boxes instead."

    def items(
        self,
        place: tuple[float, float],
        size: float,
        room: float,
        *,
        after: str = "",
        bold: bool = False,
        anchor: Literal["start", "middle"] = "start",
        colour: Rgb = BLACK,
    ) -> Iterator[Item]:
        """Yield the name.

        Parameters
        ----------
        place : (float, float)
            x and y of its base line in mm, at the side of the anchor.
        size : float
            Height of the font in mm.
        room : float
            mm that it may be wide: a text is shortened, outlines are made smaller.
        after : str
            What is written behind it.
        """
        x, y = place
        shape = None if self.fits else self.outlines
        if shape is None:
            text = shortened(self.text + after, size, room, bold=bold)
            yield Text(text, x, y, size, bold=bold, anchor=anchor, colour=colour)
            return
        behind = text_width(after, size, bold=bold)
        scale = min(size, max(room - behind, 0.0) / max(shape.width, 1e-9))
        left = x - (shape.width * scale + behind) / 2 if anchor == "middle" else x
        # a line around the letters makes them bold
        paint = Paint(fill=colour, stroke=colour, width=_BOLD) if bold else Paint(fill=colour)
        yield moved((Path(shape.points, shape.count, True, (paint,)),), left, y, scale)
        if after:
            yield Text(after, left + shape.width * scale, y, size, bold=bold, colour=colour)


_BOLD = 0.03
"""Width of the line around bold letters, in their sizes."""
