"""Layer maps: for each layer, what is laid on what, as seen from above."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from typing import Final

import numpy as np

from ..arrays import Ints, Mask
from ..building import tile_places
from ..model import Bricks, Catalogue, stud_columns
from ..progress import Progress, silent
from .canvas import WHITE, Group, Item, Page, Paint, Path, Rgb, Text, lines, moved, rectangle
from .fonts import width
from .layers import Layer, by_tiles, layers_of
from .legend import Legend, lettered
from .lots import GREY, entries_of, rgb_of
from .map_frame import LABELS, TITLE, Frame, map_room
from .paper import MARGIN, Paper, foot
from .plans import STUD, by_colour, hatched, plan_outlines, plan_studs
from .shades import DARK, LIGHT_LINE, LINE, brightness, mixed, tint_for
from .sheets import sheets
from .svg import svg
from .zoom import locator, zoomed

MAPS: Final = "Layer maps"
"""Title of the first of their pages."""

SMALLEST: Final = 1.1
"""mm of the smallest letters on bricks; smaller ones are left out."""

_GHOST: Final[Rgb] = (208, 210, 214)
_THROUGH: Final[Rgb] = (232, 233, 236)
_GRID: Final[Rgb] = (224, 226, 230)


def layer_files(pages: Iterable[Page], paper: Paper | None = None) -> Iterator[tuple[str, str]]:
    """Yield the names and contents of the files of layer maps, ``001.svg`` and so on.

    Parameters
    ----------
    pages : iterable of Page
    paper : Paper, optional
        What larger pages are cut for, into ``001-A1.svg``, ``001-A2.svg`` and so on; not at all by default.

    Yields
    ------
    (str, str)
    """
    for number, page in enumerate(pages, start=1):
        for name, sheet in [("", page)] if paper is None else sheets(page, paper):
            yield f"{number:03}{'-' * bool(name)}{name}.svg", svg(sheet) + "\n"


def layer_pages(
    bricks: Bricks,
    catalogue: Catalogue,
    *,
    temporary: Mask,
    paper: Paper,
    actual_size: bool = False,
    skip: int = 0,
    progress: Progress = silent,
) -> Iterator[Page]:
    """Draw the layer maps.

    Parameters
    ----------
    bricks : Bricks
        Model and supports, n rows.
    catalogue : Catalogue
    temporary : (n,) bool array
        Bricks that are taken out again.
    paper : Paper
        Of the pages.
    actual_size : bool
        Whether a stud is 8 mm wide on the page, so that bricks can be laid on
        its print; the page is as large as that takes.
    skip : int
        Maps from the first one on that are not drawn.
    progress : Progress

    Yields
    ------
    Page
        One a layer.
    """
    # the tint of the supports in the booklet, as the model is the same
    tint = tint_for(rgb_of(bricks.take(~temporary), catalogue))
    layers, whole = _mapped(bricks, catalogue, temporary, paper, actual_size=actual_size)
    legends = _legends(bricks, catalogue, temporary, layers, paper)
    widest = _widest(legends)
    tiles = sorted({layer.tile for layer in layers if layer.tile})
    for number, (layer, legend) in enumerate(zip(layers, legends, strict=True)):
        progress("layer maps", number / len(layers))
        if number < skip:
            continue
        new, frame = bricks.take(layer.new), whole
        if layer.tile:
            frame = Frame.of_tile(plan_outlines(new, catalogue)[0], layer.tile, whole, widest, paper)
        elif layer.box:
            frame = Frame.of_box(layer.box, whole, legend.width, paper)
        if not layer.box:
            # the map leaves so much room beside it, so that names need not be cut
            legend = legend._replace(width=widest)
        lots, lot = entries_of(new, catalogue, temporary[layer.new], tint)
        items = (
            *_heading(layer, f"{number + 1} of {len(layers)}", frame, actual_size=actual_size),
            *_labels(frame),
            Group(tuple(_plan(bricks, catalogue, layer, temporary, tint, frame)), frame.matrix),
            *_marks(new, lot, catalogue, frame),
            moved(tuple(legend.items(lots, catalogue)), frame.width - MARGIN - legend.width, MARGIN + TITLE),
            *(_where(layer.tile, tiles, frame) if layer.tile else ()),
            *(_place(layer, bricks, catalogue, whole, frame) if layer.box else ()),
        )
        yield Page(frame.width, frame.height, items, layer.title)


def _mapped(
    bricks: Bricks, catalogue: Catalogue, temporary: Mask, paper: Paper, *, actual_size: bool
) -> tuple[list[Layer], Frame]:
    """Return what gets a map each, and the frame of maps that show the whole."""
    layers = by_tiles(layers_of(bricks, catalogue), tile_places(bricks, catalogue))
    legend = _widest(_legends(bricks, catalogue, temporary, layers, paper))
    whole = Frame.of(bricks, catalogue, legend, paper, actual_size=actual_size)
    if not actual_size:
        layers = zoomed(layers, bricks, catalogue, whole, map_room(legend, paper), SMALLEST / _LETTER)
    return layers, whole


_LETTER: Final = 0.4
"""Height of the letters on bricks, in studs."""


def _place(layer: Layer, bricks: Bricks, catalogue: Catalogue, whole: Frame, frame: Frame) -> Iterator[Item]:
    """Yield a small picture of the whole layer at the head of the page, with a box around what the map shows."""
    items = locator(layer, bricks, catalogue, whole, (2.2 * _HEAD, _HEAD))
    yield moved(items, frame.width - MARGIN - 24 - 2.2 * _HEAD, MARGIN - 2)


def _where(tile: tuple[int, int], tiles: Sequence[tuple[int, int]], frame: Frame) -> Iterator[Item]:
    """Yield a small picture of all tiles at the head of the page, with one of them filled."""
    rows, columns = (max(each) + 1 for each in zip(*tiles, strict=True))
    side = min(_HEAD / rows, 2 * _HEAD / columns)
    left = frame.width - MARGIN - 24 - columns * side
    for row, column in tiles:
        paint = Paint(fill=GREY if (row, column) == tile else WHITE, stroke=_GHOST, width=0.2)
        yield rectangle(left + column * side, MARGIN - 2 + (rows - 1 - row) * side, side, side, paint)


_HEAD: Final = 11.0
"""mm of the picture of all tiles."""


def _legends(
    bricks: Bricks, catalogue: Catalogue, temporary: Mask, layers: Iterable[Layer], paper: Paper
) -> list[Legend]:
    """Return the legends of maps."""
    rows = [layer.new for layer in layers]
    counts = [len(entries_of(bricks.take(new), catalogue, temporary[new], WHITE)[0]) for new in rows]
    return [Legend.of(count, paper.height - 2 * MARGIN - TITLE) for count in counts]


def _widest(legends: Iterable[Legend]) -> float:
    return max(legend.width for legend in legends)


def _heading(layer: Layer, number: str, frame: Frame, *, actual_size: bool) -> Iterator[Item]:
    yield Text(layer.title, MARGIN, MARGIN + 7, 8, bold=True)
    bricks = f"{len(layer.new)} brick{'s' * (len(layer.new) != 1)}"
    note = f"{bricks}, actual size: print at 100 %" if actual_size else bricks
    yield Text(note, MARGIN + width(layer.title, 8, bold=True) + 5, MARGIN + 7, 4, colour=GREY)
    yield Text(number, frame.width - MARGIN, MARGIN + 7, 4, anchor="end", colour=GREY)


def _labels(frame: Frame) -> Iterator[Item]:
    """Yield the numbers of the columns and the letters of the rows, on both sides, as dense as they can be read."""
    # so far apart that they can be read
    every = next(step for step in (1, 2, 5, 10, 20, 50, 100, 1000) if step * frame.stud >= 3.5)
    (x_low, y_low), (x_high, y_high) = frame.low.tolist(), frame.high.tolist()
    for axis, ends in enumerate(((y_low, y_high), (x_low, x_high))):
        start = int((frame.low - frame.first)[axis])
        numbers = range(start, start + (x_high - x_low, y_high - y_low)[axis])
        names = [lettered(each) if axis else str(each + 1) for each in numbers]
        # and so small that the longest has room
        size = min(2.8, 0.75 * frame.stud * every, 0.85 * frame.stud * every / width(names[-1], 1))
        for number in range(0, len(names), every):
            for end, out in zip(ends, (-1, 1), strict=True):
                place = (x_low + number + 0.5, end) if axis == 0 else (end, y_low + number + 0.5)
                yield _label(names[number], frame, place, axis, out, size)
    yield _front(frame)


def _label(name: str, frame: Frame, place: tuple[float, float], axis: int, out: int, size: float) -> Item:
    """Return one label beside the map, at a place on its rim; `out` is the side of the other axis."""
    x, y = frame.at(*place)
    if (axis == 0) != frame.turned:
        # above or below; turned maps have the greater x at the top, too
        return Text(name, x, y + (1.5 + size if out < 0 else -1.5), size, anchor="middle", colour=GREY)
    right = (out > 0) != frame.turned
    return Text(
        name, x + (1.5 if right else -1.5), y + 0.36 * size, size, anchor="start" if right else "end", colour=GREY
    )


def _front(frame: Frame) -> Item:
    """Return the word that says where the front of the model is."""
    x, y = frame.at(*((frame.low + frame.high) / 2).tolist())
    if frame.turned:
        x = frame.at(0, float(frame.low[1]))[0] + LABELS + 2.5
        return Group((Text("FRONT", 0, 0, 2.6, bold=True, anchor="middle", colour=GREY),), (0.0, 1.0, -1.0, 0.0, x, y))
    y = frame.at(0, float(frame.low[1]))[1] + LABELS + 2.5
    return Text("FRONT", x, y, 2.6, bold=True, anchor="middle", colour=GREY)


def _plan(
    bricks: Bricks, catalogue: Catalogue, layer: Layer, temporary: Mask, tint: Rgb, frame: Frame
) -> Iterator[Item]:
    """Yield the map of a layer, in studs."""
    line = 0.3 / frame.stud
    yield _grid(frame)
    around = tuple(_around(bricks, catalogue, layer, line))
    yield from (Group(around, clip=_box(frame)),) if layer.tile or layer.box else around
    yield from _new(bricks.take(layer.new), catalogue, temporary[layer.new], tint, line)


def _around(bricks: Bricks, catalogue: Catalogue, layer: Layer, line: float) -> Iterator[Item]:
    """Yield what was there before: what reaches through the layer, and what lies below."""
    if len(layer.through):
        points, count = plan_outlines(bricks.take(layer.through), catalogue)
        yield Path(points, count, True, (Paint(_THROUGH, _GHOST, line),))
    if len(layer.below):
        below = bricks.take(layer.below)
        points, count = plan_outlines(below, catalogue)
        yield plan_studs(below, catalogue, Paint(stroke=_GHOST, width=STUD), Paint(stroke=WHITE, width=STUD - 2 * line))
        yield Path(points, count, True, (Paint(stroke=_GHOST, width=line, dash=(0.18, 0.12)),))


def _box(frame: Frame) -> Path:
    (left, bottom), (right, top) = frame.low.tolist(), frame.high.tolist()
    corners = np.array([(left, bottom), (right, bottom), (right, top), (left, top)], dtype=np.float64)
    return Path(corners, np.array([4]), True, ())


def _grid(frame: Frame) -> Item:
    (left, bottom), (right, top) = frame.low.tolist(), frame.high.tolist()
    upright = [[(x, bottom), (x, top)] for x in range(left, right + 1)]
    level = [[(left, y), (right, y)] for y in range(bottom, top + 1)]
    return lines(np.array(upright + level, dtype=np.float64), Paint(stroke=_GRID, width=0.12 / frame.stud))


def _new(bricks: Bricks, catalogue: Catalogue, temporary: Mask, tint: Rgb, line: float) -> Iterator[Item]:
    """Yield the bricks that are laid: coloured, with studs, the supports hatched."""
    for rgb, rows in by_colour(rgb_of(bricks, catalogue)):
        some = bricks.take(rows)
        points, count = plan_outlines(some, catalogue)
        edge = LIGHT_LINE if brightness(rgb) < DARK else mixed(rgb, LINE, 0.55)
        yield Path(points, count, True, (Paint(fill=rgb),))
        yield plan_studs(some, catalogue, Paint(stroke=edge, width=STUD), Paint(stroke=rgb, width=STUD - 1.6 * line))
    if temporary.any():
        points, count = plan_outlines(bricks.take(temporary), catalogue)
        yield hatched(points, count, Paint(stroke=tint, width=1.2 * line))
    points, count = plan_outlines(bricks, catalogue)
    dark = np.array([brightness(tuple(row)) < DARK for row in rgb_of(bricks, catalogue).tolist()], dtype=bool)
    yield Path(points, count, True, (Paint(stroke=LINE, width=1.4 * line),))
    if dark.any():
        # a light line within the dark one parts bricks of dark colours
        points, count = plan_outlines(bricks.take(dark), catalogue)
        yield Path(points, count, True, (Paint(stroke=LIGHT_LINE, width=0.6 * line),))


def _marks(bricks: Bricks, lot: Ints, catalogue: Catalogue, frame: Frame) -> Iterator[Item]:
    """Yield the letter of its lot on the first stud of each brick."""
    size = _LETTER * frame.stud
    if size < SMALLEST:
        return
    first, columns = stud_columns(bricks, catalogue)
    _, rows = np.unique(first, return_index=True)
    dark = [brightness(tuple(row)) < 0.5 for row in rgb_of(bricks, catalogue).tolist()]
    places = columns[rows] + bricks.shift
    for (x, y, _), one, on_dark in zip(places.tolist(), lot.tolist(), dark, strict=True):
        across, down = frame.at(x + 0.5, y + 0.5)
        letters = lettered(one)
        high = size / max(1, 0.7 * len(letters))
        yield Text(letters, across, down + 0.36 * high, high, anchor="middle", colour=WHITE if on_dark else LINE)


def map_pages(
    bricks: Bricks,
    catalogue: Catalogue,
    *,
    temporary: Mask,
    paper: Paper,
    first: int,
    skip: int = 0,
    progress: Progress = silent,
) -> Iterator[Page]:
    """Draw the layer maps, as many on a page as can be read; see :func:`layer_pages`.

    Parameters
    ----------
    first : int
        Number of the first page.
    skip : int
        Pages from the first one on that are not drawn.
    """
    rows = 1
    for several in (3, 2):
        _, frame = _mapped(bricks, catalogue, temporary, _strip(paper, several), actual_size=False)
        if frame.stud >= _READABLE:
            rows = several
            break
    strip = _strip(paper, rows)
    drawn = layer_pages(bricks, catalogue, temporary=temporary, paper=strip, skip=skip * rows, progress=progress)
    start = skip * rows
    while some := list(islice(drawn, rows)):
        items = [moved(tuple(each.items), 0, number * strip.height) for number, each in enumerate(some)]
        yield Page(
            paper.width, paper.height, (*items, *foot(first + start // rows, paper)), some[0].title if start else MAPS
        )
        start += rows


_READABLE: Final = 3.2
"""mm of a stud at least where several maps are on a page."""


def _strip(paper: Paper, rows: int) -> Paper:
    """Return the part of a page for a map if there are so many below each other."""
    return Paper(paper.width, (paper.height - MARGIN / 2) / rows)
