"""A model, its pieces and its supports as one LDraw multi-part document.

References
----------
LDraw.org, "MPD Extension".
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..model import Assembly, Bricks, Role
from ..safe_text import one_line
from .ldraw import LINE_END, MAIN_COLOUR, MATRICES, body, header

_REMOVED: Final = "support-outside"
_SUPPORTS: Final = (Role.SUPPORT_OUTSIDE, Role.SUPPORT_INSIDE)


def write_mpd(assembly: Assembly, *, name: str, title: str) -> str:
    """Write bricks as a multi-part document in assembly order.

    The supports of a piece come before the piece, pieces by their number, each
    as a sub-model with its own steps; the main model calls them one by one. What
    is taken out of a piece before it is joined would lie in the others' way: it
    is called, together with the piece, by a sub-model "on-table" that the main
    model leaves out. A model in one piece without supports is not divided.

    Parameters
    ----------
    assembly : Assembly
        The model and its supports, in any order.
    name : str
        Name of the main model, "model.ldr"; "model-" is put before one that a
        sub-model has.
    title : str
        What the model shows.

    Returns
    -------
    str
        The text with CRLF line ends.
    """
    groups = _groups(assembly.bricks)
    name = _main_name(name, groups)
    if len(groups) <= 1:
        return LINE_END.join([f"0 FILE {name}", *header(name, title), *body(assembly), "0 NOFILE", ""])
    aside = [group for group in groups if group.startswith(_REMOVED) and group != f"{_REMOVED}-0"]
    lines = [f"0 FILE {name}", *header(name, title), *_calls(group for group in groups if group not in aside)]
    for group, rows in groups.items():
        lines += _file(group, title)
        lines += body(assembly.take(rows))
    for removed in aside:
        piece = removed.removeprefix(_REMOVED)
        lines += _file(f"on-table{piece}", title)
        lines += _calls(group for group in groups if group.endswith(piece))
    return LINE_END.join([*lines, "0 NOFILE", ""])


def _main_name(name: str, groups: Iterable[str]) -> str:
    """Return the name of the main model, in one line; two models of one name would be one that contains itself."""
    line = one_line(name)
    stem = line.lower().removesuffix(".ldr")
    return f"model-{line}" if stem in groups or stem.startswith("on-table") else line


def _file(name: str, title: str) -> list[str]:
    return ["0 NOFILE", f"0 FILE {name}.ldr", *header(f"{name}.ldr", f"{title}, {name}")]


def _calls(groups: Iterable[str]) -> list[str]:
    return [f"1 {MAIN_COLOUR} 0 0 0 {MATRICES[0]} {group}.ldr{LINE_END}0 STEP" for group in groups]


def _groups(bricks: Bricks) -> dict[str, NDArray[np.intp]]:
    """Return the rows of each sub-model by its name, in assembly order."""
    groups = {}
    for piece in np.unique(bricks.piece).tolist():
        mine = bricks.piece == piece
        for role in _SUPPORTS:
            groups[f"{role.name.lower().replace('_', '-')}-{piece}"] = np.flatnonzero(mine & (bricks.role == role))
        groups[f"piece-{piece}"] = np.flatnonzero(mine & ~np.isin(bricks.role, _SUPPORTS))
    return {group: rows for group, rows in groups.items() if len(rows)}
