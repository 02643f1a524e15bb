"""One picture of a step with all that belongs to it: number, parts, signs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..building import Action, Kind, Steps, building_contacts, unbalanced
from ..model import NOBODY, Assembly, Bricks, Catalogue
from ..progress import Progress, silent
from .canvas import Item, Paint, Path, Rgb
from .closeup import Window, cut, framed, grown, locator, window_of
from .half_slabs import slabs_of
from .lattice import FRONT, Sight, View
from .lots import rgb_of, shown_rgb
from .picture import Look, Picture, at, extent
from .regions import outlines
from .shades import pale
from .shots import Shot, shots
from .sightlines import Scene, Stage, removal, scenes
from .slopes import draw_all
from .standing import Standing, table_grid, ways_down

_GHOST: Final = Paint(stroke=(120, 124, 130), width=2.2, dash=(9.0, 7.0))


@dataclass(frozen=True, slots=True, eq=False)
class Panel:
    """What one picture of the booklet shows.

    Attributes
    ----------
    shot : Shot
    letter : str
        "a", "b" and so on where a step has several pictures, else empty.
    last : bool
        Whether it is the last picture of its step.
    view : View
    stays, new, left_out : int64 array
        Rows of the bricks that were there, that come, and that are drawn in outline.
    placed : int64 array
        Rows of the new bricks that are listed as parts.
    turned : View or None
        The view before, if it was another one.
    window : (low, high) or None
        The part of the picture that is shown, None for the whole.
    size : (2,) float64 array
        Width and height of what is shown in the units of the picture.
    shares : (k,) float64 array
        Share of what could be seen of each new brick that is seen.
    lift : int
        Plates by which the new bricks are drawn above their places, as they would hide those.
    """

    shot: Shot
    letter: str
    last: bool
    view: View
    stays: Ints
    new: Ints
    left_out: Ints
    placed: Ints
    turned: View | None
    window: Window | None
    size: Floats
    shares: Floats
    lift: int


class Panels:
    """The pictures of all steps of a model.

    Parameters
    ----------
    bricks : Bricks
        Model and supports.
    catalogue : Catalogue
    steps : Steps
    temporary : bool array
        Bricks that are taken out again.
    tint : tuple of three int
        Colour in which supports are drawn.
    room : (float, float), optional
        mm on paper for the largest picture; what would be too small there is shown in part.
    """

    def __init__(
        self,
        bricks: Bricks,
        catalogue: Catalogue,
        steps: Steps,
        temporary: Mask,
        tint: Rgb,
        room: tuple[float, float] = (np.inf, np.inf),
    ) -> None:
        self.bricks, self.catalogue, self.steps, self.temporary, self.tint = bricks, catalogue, steps, temporary, tint
        self.stage, self._room = Stage(bricks, catalogue), room
        self.standing = Standing(bricks, catalogue)
        self._smooth = ~catalogue.studs[bricks.part]
        self.shots = list(shots(steps, temporary=temporary))
        self._own = own = shown_rgb(bricks, catalogue, temporary, tint)
        self._pale = np.array([pale(_rgb(row)) for row in own], dtype=np.int64).reshape(-1, 3)
        self.names = submodel_names(steps)
        self.held = _held(Assembly(bricks, catalogue), steps, temporary)
        self._views: dict[int, View] = {}
        self._found: list[Panel] = []
        self._looked = 0
        self._letters = dict.fromkeys(range(len(steps)), 0)

    def holds(self, panel: Panel) -> bool:
        """Tell whether what a picture shows has to be held, or it would fall over."""
        return panel.shot.step.number in self.held and panel.shot.submodel == panel.shot.step.submodel

    def all(self, progress: Progress = silent) -> list[Panel]:
        """Return the pictures of all steps; what was found before it was stopped is not looked for again."""
        while self._looked < len(self.shots):
            progress("pictures", self._looked / len(self.shots))
            self._found += self.of(self.shots[self._looked])
            self._looked += 1
        return self._found

    def of(self, shot: Shot) -> list[Panel]:
        """Return the pictures of a step; of one table they are to be asked for in order."""
        table, step = shot.submodel, shot.step
        before = first = self._views.get(table, FRONT)
        fresh = not len(shot.before)
        found: list[tuple[Scene, View | None]] = []
        for scene in self._scenes(shot, first):
            if shot.step.action == Action.REMOVE and scene.view.below:
                # one looks at it from below, and leaves it standing
                found.append((scene, None))
                continue
            found.append((scene, None if scene.view == before or fresh else before))
            before, fresh = scene.view, False
        self._views[table] = before
        start = self._letters[step.number]
        self._letters[step.number] += len(found)
        lettered = not shot.alone or len(found) > 1
        letters = [chr(ord("a") + start + number) if lettered else "" for number in range(len(found))]
        panels, stays = [], shot.stays
        for letter, (scene, turned) in zip(letters, found, strict=True):
            low, high = extent(scene.sight)
            lift = 0
            if self.may_lift(shot):
                scene, lift = self.standing.lifted(self.stage, scene, stays)
                low, high = _around((low, high), extent(scene.sight))
            drawn = np.setdiff1d(stays, scene.left_out)
            listed = scene.new[np.isin(scene.new, shot.placed)]
            window = window_of(scene.sight, scene.new, self._room)
            low, high = window or (low, high)
            last = letter == letters[-1] and table == step.submodel
            panels.append(
                Panel(shot, letter, last, scene.view, drawn, scene.new, scene.left_out, listed, turned, window,
                      high - low, scene.shares, lift)
            )  # fmt: skip
            stays = np.concatenate([stays, scene.new])
        return panels

    def _scenes(self, shot: Shot, first: View) -> list[Scene]:
        if shot.step.action == Action.REMOVE:
            return [removal(self.stage, shot.stays, shot.placed, first, self.standing.groups(shot.placed))]
        # what lies on its back stands again before something is put on from above
        first = first if shot.step.pressed else first._replace(below=False)
        return list(scenes(self.stage, shot.stays, shot.placed, shot.came, first, below=shot.step.pressed))

    def picture(self, panel: Panel, room: tuple[float, float] = (0.0, 0.0)) -> Picture:
        """Draw the picture of a panel; where a part is shown, as much of it as there is room for, in its units."""
        new = np.zeros(len(self.bricks), dtype=bool)
        new[panel.new] = True
        colour = np.where(new[:, None], self._own, self._pale)
        sight = self._sight(panel)
        window, whole = None, extent(sight)
        if panel.lift:
            # the places to which new bricks come down are within the picture, too
            whole = _around(whole, extent(self.stage.sight(np.concatenate([panel.stays, panel.new]), panel.view)))
        if panel.window is not None:
            window = grown(panel.window, sight, np.array(room))
            sight = cut(sight, window)
        made = draw_all(sight, Look(colour, new, studs=not panel.view.below, smooth=self._smooth))
        ghosts = list(_outlines(self.stage.sight(panel.left_out, panel.view))) if len(panel.left_out) else []
        stands = self.loose(panel.shot) and not panel.view.below
        grid = [table_grid(sight, *(window or whole))] if stands else []
        ways = ways_down(sight, self.standing.joints(panel.stays, panel.new)[1], panel.lift) if panel.lift else ()
        items = (*grid, *made.items, *ways, *ghosts)
        if window is not None:
            return Picture(framed(items, window), *window)
        if not ghosts:
            return Picture(items, *_around(whole, (made.low, made.high)))
        points = np.concatenate([np.stack([made.low, made.high]), *(ghost.points.astype(float) for ghost in ghosts)])
        return Picture(items, points.min(axis=0), points.max(axis=0))

    def _sight(self, panel: Panel) -> Sight:
        lifted = (panel.new, panel.lift) if panel.lift else None
        return self.stage.sight(np.concatenate([panel.stays, panel.new]), panel.view, lifted)

    def loose(self, shot: Shot) -> bool:
        """Tell whether groups stand apart in a step: a grid on the table tells how far."""
        return shot.step.action != Action.REMOVE and self.standing.apart(np.concatenate([shot.before, shot.new]))

    def may_lift(self, shot: Shot) -> bool:
        """Tell whether new bricks are drawn above their places in a step, if they hide those."""
        return self.steps.submodels[shot.submodel].kind == Kind.SUBASSEMBLY

    def locator(self, panel: Panel, picture: Picture) -> list[Item]:
        """Draw the small picture of the whole that says which part a picture shows; nothing if it shows all."""
        if panel.window is None:
            return []
        sight = self._sight(panel)
        return locator(sight, panel.new, (picture.low, picture.high))

    def whole(self, view: View, rows: Ints) -> Picture:
        """Draw bricks in their own colours, as they are in the end."""
        sight = self.stage.sight(rows, view)
        new = np.ones(len(self.bricks), dtype=bool)
        look = Look(rgb_of(self.bricks, self.catalogue), new, studs=not view.below, smooth=self._smooth)
        return draw_all(sight, look)


def _around(one: Window, other: Window) -> Window:
    return np.minimum(one[0], other[0]), np.maximum(one[1], other[1])


def _rgb(row: Ints) -> Rgb:
    red, green, blue = row.tolist()
    return red, green, blue


def _outlines(sight: Sight) -> Iterator[Path]:
    for slab in slabs_of(sight):
        region = np.where(slab.sight.bricks == NOBODY, NOBODY, 0)
        loops = outlines(region, slab.sight.low)
        yield Path(at(loops.points) + slab.by, loops.count, True, (_GHOST,))


def _held(assembly: Assembly, steps: Steps, temporary: Mask) -> frozenset[int]:
    """Return the steps in which something falls over that nobody holds."""
    contacts = building_contacts(assembly, temporary=temporary)
    towers, leaning = unbalanced(steps, assembly, contacts.pairs)
    return frozenset(each.step for each in (*towers, *leaning))


def built_at_once(steps: Steps, names: Mapping[int, str], table: int) -> str:
    """Return what stands over a table: its name, or those of the equal pieces that are built at once."""
    pieces = [str(each.piece + 1) for each in steps.submodels if each.kind == Kind.PIECE and each.like == table]
    return f"Pieces {' and '.join(pieces)}" if len(pieces) > 1 else names[table]


def submodel_names(steps: Steps) -> dict[int, str]:
    """Return what submodels are called in the booklet: counted in the order in which they are begun, equal ones alike.

    Parameters
    ----------
    steps : Steps

    Returns
    -------
    dict of int to str
        By number; empty for the model itself.
    """
    names = {each.number: f"Piece {each.piece + 1}" for each in steps.submodels if each.kind == Kind.PIECE}
    names |= {each.number: "" for each in steps.submodels if each.kind == Kind.MAIN}
    count = 0
    for step in steps:
        for table in (*step.made, step.submodel):
            first = steps.submodels[table].like
            if first not in names:
                count += 1
                names[first] = f"Sub-assembly {count}"
    return {each.number: names.get(each.number) or names.get(each.like, "") for each in steps.submodels}
