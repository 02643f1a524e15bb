"""How a panel is laid out: number, parts and signs above, the picture below."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Final

from ..building import Action
from .canvas import Item, Paint, Rgb, Text, moved, rectangle
from .closeup import LOCATOR
from .fonts import width, wrapped
from .icons import arrow, hold_sign, turn_sign
from .lots import GREY, Callout, callout, entries_of, placed
from .panels import Panel, Panels, built_at_once
from .picture import MM

BOX: Final[Rgb] = (221, 235, 247)
"""Behind the parts of a step."""

SUB: Final[Rgb] = (255, 248, 226)
"""Behind what is built by itself."""

_PARTS: Final = 0.4
"""mm on paper for a mm of the parts in callouts."""

_NUMBER: Final = 9.0
_PAD: Final = 2.0


def title_of(panels: Panels, panel: Panel) -> str:
    """Return what stands over a panel: what is built by itself, put on, or taken out; empty for the model itself."""
    step = panel.shot.step
    if step.action == Action.REMOVE:
        return "Take out the supports"
    if len(panel.new) > len(panel.placed):
        return f"Put on {_names(panels.names, panel.shot.joined)}"
    return built_at_once(panels.steps, panels.names, panel.shot.submodel)


def _names(names: Mapping[int, str], joined: Sequence[int]) -> str:
    """Return the names of what is put on, equal ones counted: "piece 2, sub-assemblies 1 and 2x 4"."""
    count = Counter(names[number] for number in joined)
    pieces = [name.lower() for name in count if name.startswith("Piece")]
    small = [f"{n}x {name.split()[1]}" if n > 1 else name.split()[1] for name, n in count.items() if "Sub" in name]
    if not small:
        return ", ".join(pieces)
    listed = f"{', '.join(small[:-1])} and {small[-1]}" if len(small) > 1 else small[0]
    return ", ".join([*pieces, f"sub-assembl{'ies' if len(small) > 1 else 'y'} {listed}"])


def header(panels: Panels, panel: Panel, room: float) -> Callout:
    """Return the upper part of a panel: its number, the parts, the signs.

    Parameters
    ----------
    panels : Panels
    panel : Panel
    room : float
        Its width in mm.

    Returns
    -------
    Callout
    """
    items: list[Item] = []
    aside = LOCATOR[0] + _PAD if panel.window is not None else 0.0
    room -= aside
    number = f"{panel.shot.step.number + 1}{panel.letter}"
    x = width(number, _NUMBER, bold=True) + 4
    items.append(Text(number, 0, _NUMBER * 0.78, _NUMBER, bold=True))
    times = panel.shot.times
    if times > 1:
        items.append(Text(f"{times}x", 0, _NUMBER * 0.78 + 7, 5, bold=True, colour=GREY))
    y = 0.0
    title = title_of(panels, panel)
    if title:
        lines = wrapped(title, 4.2, max(room - x, 30), bold=True)
        items += [Text(line, x, 4.2 + 5 * row, 4.2, bold=True) for row, line in enumerate(lines)]
        y = 1.5 + 5 * len(lines)
    signs = _signs(panel, hold=panels.holds(panel))
    box = _parts(panels, panel, room - x - 2 * _PAD)
    bottom = max(_NUMBER, y + box.height)
    right = x
    if box.width:
        items.append(moved(box.items, x, y))
        right = x + box.width + 3
    if signs.width and right + signs.width <= room:
        items.append(moved(signs.items, right, y))
        right, bottom = right + signs.width, max(bottom, y + signs.height)
    elif signs.width:
        items.append(moved(signs.items, x, bottom + 2))
        right, bottom = max(right, x + signs.width), bottom + 2 + signs.height
    least = LOCATOR[1] if aside else 16.0 if times > 1 else 0.0
    return Callout(tuple(items), right + aside, max(bottom, least))


def _parts(panels: Panels, panel: Panel, room: float) -> Callout:
    """Return the box with the parts of a panel, the supports in the colour in which they are drawn."""
    if not len(panel.placed):
        return Callout((), 0.0, 0.0)
    some = panels.bricks.take(panel.placed)
    lots, _ = entries_of(some, panels.catalogue, panels.temporary[panel.placed], panels.tint)
    inside = callout(lots, panels.catalogue, room=room, scale=_PARTS)
    wide, high = inside.width + 2 * _PAD, inside.height + 2 * _PAD
    box = rectangle(0, 0, wide, high, Paint(fill=BOX))
    return Callout((box, moved(inside.items, _PAD, _PAD)), wide, high)


def _signs(panel: Panel, *, hold: bool) -> Callout:
    """Return the signs for what the hands do beside pushing bricks on."""
    items: list[Item] = []
    x = 0.0
    if panel.turned is not None:
        over = panel.turned.below != panel.view.below
        items += turn_sign(x + 6, 4.5, 3.6, over=over)
        x += _signed(items, x, "turn over" if over else "turn") + 2
    removed = panel.shot.step.action == Action.REMOVE
    if removed and panel.view.below:
        items += turn_sign(x + 6, 4.5, 3.6, over=True)
        x += _signed(items, x, "seen from below") + 2
    if panel.shot.step.pressed and not removed:
        items += arrow((x + 6, 8.5), (x + 6, 1))
        x += _signed(items, x, "press from below") + 2
    if hold:
        items += hold_sign(x + 6, 5, 4.5)
        x += _signed(items, x, "hold") + 2
    if len(panel.left_out):
        items.append(rectangle(x + 2, 2, 8, 6, Paint(stroke=GREY, width=0.4, dash=(1.4, 1.1))))
        x += _signed(items, x, "not shown here")
    return Callout(tuple(items), x, 12.5 if x else 0.0)


def _signed(items: list[Item], x: float, text: str) -> float:
    """Put a word below a sign; return how wide the two are."""
    wide = max(12.0, width(text, 2.6))
    items.append(Text(text, x, 12, 2.6, colour=GREY))
    return wide


def panel_items(panels: Panels, panel: Panel, wide: float, high: float, scale: float) -> list[Item]:
    """Lay out a panel from (0, 0) on.

    Parameters
    ----------
    panels : Panels
    panel : Panel
    wide, high : float
        Its size in mm.
    scale : float
        mm on paper for a mm of the model; less if the picture does not fit otherwise.
    """
    top = header(panels, panel, wide)
    free = wide, high - top.height - 3
    picture = panels.picture(panel, (free[0] / (scale * MM), free[1] / (scale * MM)))
    unit = min(scale * MM, free[0] / picture.size[0], free[1] / picture.size[1])
    left, down = (free[0] - picture.size[0] * unit) / 2, top.height + 3 + (free[1] - picture.size[1] * unit) / 2
    small = moved(panels.locator(panel, picture), wide - LOCATOR[0], 0) if panel.window is not None else None
    return [*top.items, *([small] if small else []), placed(picture, left, down, unit / MM)]
