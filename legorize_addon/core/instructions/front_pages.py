"""The pages before and after the steps: cover, what the signs mean, parts, the finished model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np

from ..building import Kind
from ..model import Bricks, Catalogue
from ..progress import duration
from ..shopping import SECONDS_A_BRICK
from ..units import PLATE, STUD, count_of
from .canvas import Item, Page, Paint, Rgb, Text, lines, moved, rectangle
from .fonts import shortened, width, wrapped
from .icons import arrow, hold_sign, turn_sign
from .lattice import FRONT, View
from .lettering import Title
from .lots import ANY, GREY, Lot, entries_of, lots_of, picture_of, placed
from .panel_layout import SUB
from .panels import Panels
from .paper import FOOT, MARGIN, Paper, foot
from .picture import MM, Picture
from .plans import plan_outlines
from .shades import PALE, mixed, tinted
from .standing import LIFTED

DISCLAIMER: Final = (
    "LEGO is a trademark of the LEGO Group, which does not sponsor, authorize or endorse this model or this booklet."
)

_MM_PER_CM: Final = 10.0

_SIGN: Final = 12.0
"""mm from one sign to the next at least: as high as they are."""

_VALUE, _WHAT = 7.5, 3.6
"""mm of the letters of a figure on the cover, and of what it is."""


def cover(panels: Panels, title: Title, paper: Paper) -> Page:
    """Return the cover: picture, name, size, parts, time."""
    finished = np.flatnonzero(~panels.temporary)
    model = panels.bricks.take(finished)
    picture = panels.whole(FRONT, finished)
    items: list[Item] = [
        rectangle(0, 0, paper.width, paper.height, Paint(fill=(244, 248, 252))),
        rectangle(0, paper.height - 34, paper.width, 34, Paint(fill=(0, 92, 160))),
        *title.items((MARGIN + 2, MARGIN + 14), 15, paper.width - 2 * MARGIN, bold=True),
        Text("Building instructions", MARGIN + 2, MARGIN + 22, 6, colour=GREY),
        _fitted(picture, MARGIN, MARGIN + 26, paper.width - 2 * MARGIN, paper.height - 34 - MARGIN - 32),
    ]
    facts = _facts(panels, model)
    wide = [max(width(value, _VALUE, bold=True), width(what, _WHAT)) for value, what in facts]
    # as much room behind the long ones as behind the short ones: readers have wider fonts than ours
    x, gap = MARGIN + 2, (paper.width - 2 * MARGIN - 4 - sum(wide)) / len(facts)
    for (value, what), room in zip(facts, wide, strict=True):
        items.append(Text(value, x, paper.height - 19, _VALUE, bold=True, colour=(255, 255, 255)))
        items.append(Text(what, x, paper.height - 11, _WHAT, colour=(214, 230, 244)))
        x += room + gap
    return Page(paper.width, paper.height, items, "Cover")


def _facts(panels: Panels, model: Bricks) -> list[tuple[str, str]]:
    """Return what the cover says of a model: figures, and what they are."""
    points, _ = plan_outlines(model, panels.catalogue)
    height = panels.catalogue.height[model.part]
    across, deep = (np.ptp(points, axis=0) * STUD / _MM_PER_CM).tolist()
    high = float((model.corner[:, 2] + height).max() - model.corner[:, 2].min()) * PLATE / _MM_PER_CM
    supports = int(panels.temporary.sum())
    lots, _ = lots_of(model, panels.catalogue)
    colours = len(np.unique(model.colour))
    kinds, below = count_of(len(lots), "kind", "kinds"), count_of(supports, "support brick", "support bricks")
    return [
        (f"{across:.0f} x {deep:.0f} x {high:.0f} cm", "wide, deep, high"),
        (count_of(len(model), "brick", "bricks"), f"{kinds} in {count_of(colours, 'colour', 'colours')}"),
        (count_of(len(panels.steps), "step", "steps"), f"with {below} to take out" if supports else "no supports"),
        (f"about {duration(SECONDS_A_BRICK * len(panels.steps.moves))}", "for practised hands"),
    ]


def _fitted(picture: Picture, x: float, y: float, wide: float, high: float) -> Item:
    """Return a picture in the middle of a box, as large as fits."""
    unit = min(wide / picture.size[0], high / picture.size[1], 1.2 * MM)
    left, top = (np.array([wide, high]) - picture.size * unit) / 2
    return placed(picture, x + left, y + top, unit / MM)


def how_to_read(panels: Panels, paper: Paper, number: int, remarks: Sequence[str] = ()) -> Page:
    """Return the page that tells what colours and signs mean, as far as this model has them, and remarks."""
    items: list[Item] = [Text("How to read the steps", MARGIN, MARGIN + 8, 9, bold=True)]
    y = MARGIN + 22.0
    signs = [(sign, wrapped(text, 5, paper.width - 2 * MARGIN - 32)) for sign, text in _signs(panels)]
    below = sum(6.5 * len(wrapped(remark, 5, paper.width - 2 * MARGIN)) + 4 for remark in remarks)
    # closer together where there are many
    least = [max(_SIGN, 6.5 * len(told) + 1) for _, told in signs]
    spare = (paper.height - MARGIN - FOOT - y - below - sum(least)) / len(signs)
    for (sign, told), high in zip(signs, least, strict=True):
        items.append(moved(sign, MARGIN, y))
        for row, line in enumerate(told):
            items.append(Text(line, MARGIN + 30, y + 6 + 6.5 * row, 5))
        y += min(19.0, high + max(spare, 0.0))
    for remark in remarks:
        rows = wrapped(remark, 5, paper.width - 2 * MARGIN)
        items += [Text(line, MARGIN, y + 6 + 6.5 * row, 5) for row, line in enumerate(rows)]
        y += 6.5 * len(rows) + 4
    return Page(paper.width, paper.height, (*items, *foot(number, paper)), "How to read the steps")


def _signs(panels: Panels) -> Iterator[tuple[list[Item], str]]:
    red: Rgb = (180, 0, 0)
    yield _chip(red), "New bricks are bright, with strong lines. The blue box above lists them."
    yield _chip(mixed(red, (255, 255, 255), PALE), (150, 150, 154)), "What was built before is pale."
    if panels.temporary.any():
        yield (
            _chip(tinted((244, 244, 244), panels.tint)),
            (
                "Supports have this colour in pictures and lists: take bricks of any colour. They stand below the "
                "model while it is built, and a step says when to take them out."
            ),
        )
    yield [*turn_sign(11, 5, 4.5, over=False)], "The model is seen from another side than before: turn it."
    if panels.steps.moves.pressed.any():
        yield arrow((11, 10), (11, 0)), "Press the new brick on from below, against your fingers on top."
    if panels.held:
        yield (
            hold_sign(11, 5, 6),
            "Hold what is on the table between your fingers: it would fall over until more is built.",
        )
    dashed = rectangle(4, 1, 14, 9, Paint(stroke=GREY, width=0.4, dash=(1.4, 1.1)))
    yield [dashed], "Dashed: bricks that are there, but are left out so that new ones behind them are seen."
    if any(each.kind != Kind.MAIN for each in panels.steps.submodels):
        yield (
            [rectangle(2, 0, 18, 11, Paint(fill=SUB))],
            ("Behind what is built on the table by itself and put on as a whole later; 2x means: build two."),
        )
    if any(panels.loose(shot) for shot in panels.shots):
        yield _squares(), "Squares of one stud each, where groups stand apart: they tell how far."
    if any(panels.may_lift(shot) for shot in panels.shots):
        yield (
            [lines(np.array([[(11.0, 0.0), (11.0, 11.0)]]), Paint(stroke=LIFTED, width=0.7, dash=(1.8, 1.2)))],
            "Blue lines: new bricks drawn above their places, which they would hide. Push them down along the lines.",
        )
    yield [Text("7b", 5, 9, 9, bold=True)], "A step whose bricks hide each other has several pictures: a, b, ..."


def _squares() -> list[Item]:
    thin = Paint(stroke=(150, 154, 160), width=0.2)
    ends = [[(x, 1.0), (x, 10.0)] for x in np.arange(2.0, 21.0, 3.0).tolist()]
    ends += [[(2.0, y), (20.0, y)] for y in (1.0, 4.0, 7.0, 10.0)]
    return [lines(np.array(ends), thin)]


def _chip(fill: Rgb, line: Rgb = (20, 20, 22)) -> list[Item]:
    return [rectangle(4, 1, 14, 9, Paint(fill=fill, stroke=line, width=0.5))]


def parts_pages(panels: Panels, paper: Paper, first: int) -> Iterator[Page]:
    """Yield the parts list with pictures: of the model, and then of its supports, on the same page if there is room."""
    found, _ = entries_of(panels.bricks, panels.catalogue, panels.temporary, panels.tint)
    lists = (
        ("Parts", [entry for entry in found if entry[1] is None]),
        (SUPPORT_PARTS, [entry for entry in found if entry[1] is not None]),
    )
    items: list[Item] = []
    y, title = MARGIN, "Parts"
    across, low = int((paper.width - 2 * MARGIN) / _CELL[0]), paper.height - MARGIN - FOOT
    wide = (paper.width - 2 * MARGIN) / across
    for name, entries in lists:
        for start in range(0, len(entries), across):
            head = 0.0 if start and items else _HEAD + (_APART if items else 0.0)
            if items and y + head + _CELL[1] > low:
                yield Page(paper.width, paper.height, (*items, *foot(first, paper)), title)
                items, y, first, title, head = [], MARGIN, first + 1, name, _HEAD
            y += head
            if head:
                items += _heading(name, sum(lot.count for lot, _ in entries), y - _HEAD)
            for column, (lot, tint) in enumerate(entries[start : start + across]):
                items.append(moved(_entry(lot, tint, panels.catalogue, wide - 4), MARGIN + column * wide, y))
            y += _CELL[1]
    yield Page(paper.width, paper.height, (*items, *foot(first, paper)), title)


def _heading(title: str, count: int, y: float) -> list[Item]:
    note = f"{count} brick{'s' * (count != 1)}"
    return [
        Text(title, MARGIN, y + 8, 9, bold=True),
        Text(note, MARGIN + width(title, 9, bold=True) + 5, y + 8, 4, colour=GREY),
    ]


SUPPORT_PARTS: Final = "Parts for the supports, of any colour"

_CELL: Final = (34.0, 28.5)
"""mm of an entry of the parts list."""

_HEAD: Final = 13.0
"""mm of a heading above entries."""

_APART: Final = 7.0
"""mm between the entries of a list and the heading of the next."""


def _entry(lot: Lot, tint: Rgb | None, catalogue: Catalogue, room: float) -> list[Item]:
    """Return one entry: picture, count, name, colour, and the number by which it is bought."""
    picture = picture_of(lot, catalogue, tint)
    part, colour = catalogue.parts[lot.part], catalogue.colours[lot.colour]
    unit = min(0.5 * MM, room / picture.size[0], 16.5 / picture.size[1])
    element = int(catalogue.element[lot.part, lot.colour]) if tint is None else 0
    count = f"{lot.count}x"
    step = width(count, 4.2, bold=True) + 1.5
    return [
        placed(picture, 0, 17 - picture.size[1] * unit, unit / MM),
        Text(count, 0, 21.5, 4.2, bold=True),
        Text(shortened(part.title, 2.5, room - step), step, 21.5, 2.5),
        Text(shortened(colour.name if tint is None else ANY, 2.5, room), 0, 24.8, 2.5, colour=GREY),
        Text(str(element or part.number), 0, 27.6, 2.2, colour=(150, 152, 158)),
    ]


def last_page(panels: Panels, title: Title, paper: Paper) -> Page:
    """Return the page of the finished model, from the other sides, with the one line about the trademark."""
    finished = np.flatnonzero(~panels.temporary)
    wide = (paper.width - 2 * MARGIN - 12) / 2
    high = paper.height - 2 * MARGIN - 40
    items: list[Item] = [
        rectangle(0, 0, paper.width, paper.height, Paint(fill=(244, 248, 252))),
        Text("Finished", MARGIN + 2, MARGIN + 9, 11, bold=True),
        _fitted(panels.whole(View(0), finished), MARGIN, MARGIN + 16, wide, high),
        _fitted(panels.whole(View(3), finished), MARGIN + wide + 12, MARGIN + 16, wide, high),
        Text(DISCLAIMER, paper.width / 2, paper.height - MARGIN - 6, 2.9, anchor="middle", colour=GREY),
        *title.items(
            (paper.width / 2, paper.height - MARGIN), 2.9, paper.width - 2 * MARGIN,
            after=", made with Legorize", anchor="middle", colour=GREY,
        ),
    ]  # fmt: skip
    return Page(paper.width, paper.height, items, "Finished")
