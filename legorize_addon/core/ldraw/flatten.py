"""The parts of a document where they stand in the end, sub-models put where they are called."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ..arrays import Floats, Ints
from ..errors import BuildError
from ..files import MAIN_COLOUR
from .lines import Document, Reference, Section, brief

EDGE_COLOUR: Final = 24
"""LDraw's code for the colour of the edges of a sub-model."""

MOST_PARTS: Final = 1_000_000
"""Parts of a model, or ends of steps, sub-models counted as often as they are called."""

MOST_MOVES: Final = 20 * MOST_PARTS
"""Parts of all models together: so often are parts moved until they stand where they belong."""


@dataclass(frozen=True, slots=True, eq=False)
class Parts:
    """Parts in a common frame, n rows.

    Attributes
    ----------
    name : (n,) int64 array
        Row of the part's name in a table of names.
    line : (n,) int64 array
        Line that names it.
    colour : (n,) int64 array
        Code or direct colour; ``MAIN_COLOUR`` is not decided yet.
    matrix : (n, 3, 3) float64 array
    place : (n, 3) float64 array
        Origin in LDU.
    role, piece : (n,) int64 array
    step : (n,) int64 array
        Ends of steps before it.
    """

    name: Ints
    line: Ints
    colour: Ints
    matrix: Floats
    place: Floats
    role: Ints
    piece: Ints
    step: Ints

    def __len__(self) -> int:
        """Return the number of parts."""
        return len(self.name)

    def take(self, rows: Ints | np.ndarray) -> Parts:
        """Return the given rows as a table of their own."""
        return Parts(*(getattr(self, column)[rows] for column in self.__slots__))


def flatten(document: Document, is_part: Callable[[str], bool]) -> tuple[Parts, list[str]]:
    """Put all sub-models of a document where they are called.

    Parameters
    ----------
    document : Document
    is_part : callable
        Whether a name is that of a part, although a model of the document may be
        called so too.

    Returns
    -------
    parts : Parts
        In the order of the file, those of sub-models where they are called.
    names : list of str
        Names that rows of the table mean.

    Raises
    ------
    BuildError
        A model contains itself, or there are too many parts or steps.
    """
    calls = {
        name: [item for item in section.items if item is not None and _is_model(document, item.name, is_part)]
        for name, section in document.sections.items()
    }
    order = _inner_first(document.main, calls)
    _check_number(document, order, calls)
    names: dict[str, int] = {}
    flat: dict[str, tuple[Parts, int]] = {}
    waiting = Counter(item for name in order for item in {call.name for call in calls[name]})
    for name in order:
        called = {id(item) for item in calls[name]}
        flat[name] = _flat(document.sections[name], called, flat, names)
        for inner in {item.name for item in calls[name]}:
            waiting[inner] -= 1
            if not waiting[inner]:
                del flat[inner]
    return flat[document.main][0], list(names)


def _is_model(document: Document, name: str, is_part: Callable[[str], bool]) -> bool:
    """Tell whether a name is called as a model: not if it is a part's, which some documents bring along as geometry."""
    return name in document.sections and not name.endswith(".dat") and not is_part(name)


def _inner_first(main: str, calls: dict[str, list[Reference]]) -> list[str]:
    """Return the names of models that are used, each after those that it calls; without Python's own recursion."""
    order: list[str] = []
    done: set[str] = set()
    path: dict[str, int] = {main: 0}
    while path:
        name, at = next(reversed(path.items()))
        if at == len(calls[name]):
            del path[name]
            done.add(name)
            order.append(name)
            continue
        path[name] += 1
        item = calls[name][at]
        if item.name in path:
            raise BuildError(f"Line {item.line} puts the model {brief(item.name)} into itself: remove that line.")
        if item.name not in done:
            path[item.name] = 0
    return order


def _check_number(document: Document, order: list[str], calls: dict[str, list[Reference]]) -> None:
    """Refuse documents that unfold to more than anybody builds, before they do."""
    parts: dict[str, int] = {}
    steps: dict[str, int] = {}
    for name in order:
        items = document.sections[name].items
        ends = sum(item is None for item in items)
        parts[name] = len(items) - ends - len(calls[name]) + sum(parts[item.name] for item in calls[name])
        steps[name] = ends + sum(steps[item.name] for item in calls[name])
    for what, count in (("parts", parts[document.main]), ("steps", steps[document.main])):
        if count > MOST_PARTS:
            raise BuildError(
                f"The model has more than {MOST_PARTS:,} {what}, sub-models counted as often as they are called: "
                "build it in smaller ones."
            )
    if sum(parts.values()) > MOST_MOVES:
        raise BuildError("Its sub-models lie in each other too deeply for so many parts: build it in smaller ones.")


def _flat(
    section: Section, called: set[int], flat: dict[str, tuple[Parts, int]], names: dict[str, int]
) -> tuple[Parts, int]:
    """Return the parts of a model in its own frame, and how many steps end in it."""
    tables: list[Parts] = []
    waiting: list[tuple[Reference, int]] = []
    step = 0
    for item in section.items:
        if item is None:
            step += 1
        elif id(item) in called:
            tables += [_table(waiting, names), _moved(*flat[item.name], item, step)]
            waiting = []
            step += flat[item.name][1]
        else:
            waiting.append((item, step))
    return _concatenated([*tables, _table(waiting, names)]), step


def _table(items: list[tuple[Reference, int]], names: dict[str, int]) -> Parts:
    numbers = np.array([item.numbers for item, _ in items], np.float64).reshape(-1, 12)
    whole = np.array(
        [
            (names.setdefault(item.name, len(names)), item.line, item.colour, item.role, item.piece, step)
            for item, step in items
        ],
        np.int64,
    ).reshape(-1, 6)
    name, line, colour, role, piece, steps = whole.T
    return Parts(name, line, colour, numbers[:, 3:].reshape(-1, 3, 3), numbers[:, :3], role, piece, steps)


def _moved(parts: Parts, steps: int, call: Reference, step: int) -> Parts:
    """Return the parts of a model where a line puts it, in the colour and of the piece that this gives."""
    matrix = np.array(call.numbers[3:]).reshape(3, 3)
    # models that are stretched in each other come to numbers without end, and to none at all
    with np.errstate(over="ignore", invalid="ignore"):
        return replace(
            parts,
            colour=np.where(parts.colour == MAIN_COLOUR, call.colour, parts.colour),
            matrix=matrix @ parts.matrix,
            place=parts.place @ matrix.T + np.array(call.numbers[:3]),
            # equal pieces are written once
            piece=np.full_like(parts.piece, call.piece) if call.piece else parts.piece,
            step=parts.step + step,
        )


def _concatenated(tables: list[Parts]) -> Parts:
    return Parts(*(np.concatenate([getattr(table, column) for table in tables]) for column in Parts.__slots__))
