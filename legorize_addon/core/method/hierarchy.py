"""The parent-and-son hierarchy of the trajectories as text.

References
----------
Paper, section "Parent-and-son hierarchy".
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..arrays import Floats, Ints
from ..model import Catalogue
from ..slicing import Trajectories
from .trajectory_maps import colour_name


def hierarchy_text(trajectories: Trajectories, titles: list[str], catalogue: Catalogue) -> str:
    """Write every loop below the one that holds it.

    Parameters
    ----------
    trajectories : Trajectories
    titles : list of str
        What each slice is called.
    catalogue : Catalogue

    Returns
    -------
    str
        A paragraph a slice, a line a loop: its number, side and direction, its
        area in mm², its length in mm, and the share of each colour in this.
    """
    length = lengths_by_colour(trajectories, catalogue)
    area = trajectories.areas()
    sons: list[list[int]] = [[] for _ in trajectories.loop_parent]
    roots: list[list[int]] = [[] for _ in titles]
    for loop, parent in enumerate(trajectories.loop_parent.tolist()):
        (roots[trajectories.loop_slice[loop]] if parent < 0 else sons[parent]).append(loop)
    lines: list[str] = []
    for title, outermost in zip(titles, roots, strict=True):
        walk = list(_walk(outermost, sons))
        lines.append(f"{title}: {len(walk)} loop{'s' * (len(walk) != 1)}")
        for depth, loop in walk:
            lines.append(
                "   " * depth + f"+- {loop + 1} {_side(area[loop])}, {abs(area[loop]):.1f} mm², {length[loop]}"
            )
        lines.append("")
    return "\n".join(lines)


def _walk(outermost: list[int], sons: list[list[int]]) -> Iterator[tuple[int, int]]:
    """Yield the depth and the number of each loop, sons after their parents."""
    waiting = [(0, loop) for loop in reversed(outermost)]
    while waiting:
        depth, loop = waiting.pop()
        yield depth, loop
        waiting += [(depth + 1, son) for son in reversed(sons[loop])]


def _side(area: float) -> str:
    return "exterior, counter-clockwise" if area > 0 else "interior, clockwise"


def lengths_by_colour(trajectories: Trajectories, catalogue: Catalogue) -> list[str]:
    """Return the length of each loop and the shares of its colours, in words."""
    edge = np.linalg.norm(trajectories.ends - trajectories.points, axis=1)
    codes, row = np.unique(trajectories.colour, return_inverse=True)
    total: Floats = np.bincount(trajectories.edge_loop, edge, len(trajectories.loop_slice))
    pair, of_pair = np.unique(trajectories.edge_loop * len(codes) + row, return_inverse=True)
    length = np.bincount(of_pair, edge)
    loop, colour = np.divmod(pair, len(codes))
    order = np.lexsort((-length, loop))
    words: list[list[str]] = [[] for _ in total]
    for one, code, share in _shares(loop[order], codes[colour[order]].astype(np.int64), length[order], total):
        words[one].append(f"{colour_name(code, catalogue)} {share:.0%}")
    return [f"{whole:.1f} mm: {', '.join(each)}" for whole, each in zip(total.tolist(), words, strict=True)]


def _shares(loop: Ints, code: Ints, length: Floats, total: Floats) -> Iterator[tuple[int, int, float]]:
    share = length / np.maximum(total[loop], np.finfo(float).tiny)
    yield from zip(loop.tolist(), code.tolist(), share.tolist(), strict=True)
