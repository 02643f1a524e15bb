"""From where a step is seen best: every new brick is to show what tells where it goes.

The model stays as it stands as long as each new brick shows a share of what it
could show. Else it is turned, or laid on its back; and where new bricks are
hidden from everywhere, what stands before them is left out and only drawn in
outline.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..model import Bricks, Catalogue
from .lattice import FRONT, Cells, Sight, View, look

ENOUGH: Final = 0.3
"""Share of what could be seen of a new brick that is to be seen: the top of a brick of one stud is a third of it."""

VIEWS: Final = (FRONT, *(View((FRONT.turns + turn) % 4) for turn in (1, 3, 2)))
BELOW: Final = tuple(View(turns, below=True) for turns in (0, 1, 2, 3))
"""Places of the viewer, those that are tried first before the others."""


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """What is seen of one step from one place.

    Attributes
    ----------
    view : View
    sight : Sight
    new : (k,) int64 array
        Rows of the new bricks.
    left_out : (m,) int64 array
        Rows of bricks that are there but drawn in outline, so that new ones are seen.
    shares : (k,) float64 array
        Share of what could be seen of each new brick that is seen.
    """

    view: View
    sight: Sight
    new: Ints
    left_out: Ints
    shares: Floats

    @property
    def good(self) -> bool:
        """Whether every new brick is seen well enough."""
        return bool((self.shares >= ENOUGH).all())


class Stage:
    """The bricks of a model, ready to be seen from everywhere.

    Parameters
    ----------
    bricks : Bricks
    catalogue : Catalogue
    """

    def __init__(self, bricks: Bricks, catalogue: Catalogue) -> None:
        self._bricks, self._catalogue = bricks, catalogue
        self._cells: dict[View, Cells] = {}

    def sight(self, rows: Ints, view: View, lifted: tuple[Ints, int] | None = None) -> Sight:
        """Return what is seen of some bricks, as if the others were not there; with some lifted by plates."""
        if view not in self._cells:
            self._cells[view] = Cells.of(self._bricks, self._catalogue, view)
        there = np.zeros(len(self._bricks), dtype=bool)
        there[rows] = True
        cells = self._cells[view].take(there[self._cells[view].brick])
        if lifted is not None:
            up = np.zeros_like(cells.place)
            up[np.isin(cells.brick, lifted[0]), 2] = lifted[1]
            cells = replace(cells, place=cells.place + up)
        return look(cells, len(self._bricks))

    def scene(self, stays: Ints, new: Ints, view: View) -> Scene:
        """Return what is seen of a step from one place."""
        sight = self.sight(np.concatenate([stays, new]), view)
        return Scene(view, sight, new, stays[:0], sight.shares[new])

    def best(self, stays: Ints, new: Ints, first: View, *, below: bool) -> Scene:
        """Return a step as it is seen well enough, else as well as can be.

        Parameters
        ----------
        stays, new : int64 array
            Rows of the bricks that were there before, and that come.
        first : View
            From where the step before was seen, which is kept if it will do.
        below : bool
            Whether bricks are pressed from below, so that the model may be laid on its back.

        Returns
        -------
        Scene
        """
        seen = []
        for view in dict.fromkeys((first, *VIEWS, *(BELOW if below else ()))):
            seen.append(self.scene(stays, new, view))
            if seen[-1].good:
                return seen[-1]
        most = max(seen, key=lambda scene: (int((scene.shares >= ENOUGH).sum()), float(scene.shares.min())))
        return self.opened(most, stays)

    def opened(self, scene: Scene, stays: Ints) -> Scene:
        """Leave out what stands before new bricks that are not seen well enough, as long as there is any."""
        kept = np.zeros(len(self._bricks), dtype=bool)
        kept[stays] = True
        while not scene.good:
            before = self._before(scene, kept)
            if not before.any():
                break
            kept &= ~before
            there = np.flatnonzero(kept)
            again = self.scene(there, scene.new, scene.view)
            scene = Scene(scene.view, again.sight, scene.new, np.setdiff1d(stays, there), again.shares)
        return scene

    def _before(self, scene: Scene, kept: Mask) -> Mask:
        """Tell which of the bricks that may be left out cover new ones that are not seen well enough."""
        hidden = scene.new[scene.shares < ENOUGH]
        found = np.zeros(len(self._bricks) + 1, dtype=bool)
        for brick in hidden.tolist():
            alone = self.sight(np.array([brick]), scene.view)
            m, n, half = np.nonzero(alone.bricks == brick)
            shift = alone.low - scene.sight.low
            found[scene.sight.bricks[m + shift[0], n + shift[1], half]] = True
        return found[:-1] & kept


def scenes(stage: Stage, stays: Ints, placed: Ints, came: Ints, first: View, *, below: bool) -> Iterator[Scene]:
    """Show a step, in several pictures if its bricks hide each other.

    Parameters
    ----------
    stage : Stage
    stays : int64 array
        Rows of the bricks that were there before.
    placed : int64 array
        Rows of the bricks that come one by one, in order.
    came : int64 array
        Rows of what is put on as a whole, before them.
    first : View
        From where the step before was seen.
    below : bool
        Whether bricks are pressed from below.

    Yields
    ------
    Scene
        Every brick that is placed is new in one of them and seen well enough, if that can be.
    """
    if len(came):
        # a whole is known by its size, whatever of it is hidden
        whole = max((stage.scene(stays, came, view) for view in dict.fromkeys((first, *VIEWS))), key=_seen)
        scene = stage.scene(stays, came, first)
        yield scene if _seen(scene) > _MOST * _seen(whole) else whole
        stays = np.concatenate([stays, came])
    while len(placed):
        scene = stage.best(stays, placed, first, below=below)
        count = len(placed)
        while not scene.good and count > 1:
            count -= 1
            scene = stage.best(stays, placed[:count], first, below=below)
        yield scene
        first = scene.view
        stays, placed = np.concatenate([stays, placed[:count]]), placed[count:]


def removal(stage: Stage, stays: Ints, taken: Ints, first: View, stacks: Ints) -> Scene:
    """Show what is taken out: from below where it is hidden from above.

    Parameters
    ----------
    stage : Stage
    stays, taken : int64 array
        Rows of the bricks that stay, and that are taken out.
    first : View
        From where the step before was seen, above, which is kept if it will do.
    stacks : (n_taken,) int64 array
        Number of the stack of each of those: of each one brick is to be seen.

    Returns
    -------
    Scene
    """
    views = dict.fromkeys((first, *(View(turns) for turns in range(4)), *BELOW))
    seen = {view: stage.scene(stays, taken, view) for view in views}
    shown = {view: len(np.unique(stacks[scene.shares >= _KNOWN])) for view, scene in seen.items()}
    best = max(shown.values())
    # nobody looks from below for what is seen as well from above
    below = max(shown[view] for view in views if not view.below) < best
    good = [view for view in views if shown[view] == best and view.below == below]
    most = max(float(seen[view].shares.mean()) for view in good)
    return next(seen[view] for view in good if seen[view].shares.mean() >= _NEARLY * most)


_KNOWN: Final = 0.15
"""Share by which a brick that is there, and is taken out, is known: one side of a plate of one stud is a fifth."""

_NEARLY: Final = 0.8
"""Share of the best view of what is taken out with which the model is not turned."""

_MOST: Final = 0.6
"""Share of the greatest view of a whole with which the model is not turned."""


def _seen(scene: Scene) -> float:
    """Return how much is seen of all that is new, in pieces of the plane."""
    return float(scene.shares @ scene.sight.free[scene.new])
