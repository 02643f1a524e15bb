"""Changes by hand of a build in the scene: made in its bricks at once, and kept with it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

import bpy
import numpy as np

from ..core.edits import Edit, Edits, edits_text, read_edits, rules_of
from ..core.errors import EditError
from ..core.model import NOBODY, SUPPORTS, Assembly, Bricks, Role, load_catalogue
from ..scene import (
    Detail,
    Model,
    Source,
    bricks_text,
    check_whole,
    found_colours,
    keep_found_colours,
    read_bricks,
    read_bricks_text,
    show_build,
    sources_of,
    state_of,
    surface_of,
)
from .kept_view import KeptView

if TYPE_CHECKING:
    from ..core.edits import Outcome
    from ..core.statics import Stability


OTHER_SIZE: Final = (
    "The changes of this model are kept for another size: build it in that size again, or remove them from the list."
)


@dataclass(frozen=True, slots=True, eq=False)
class Changed:
    """A build after changes by hand, not yet shown.

    Attributes
    ----------
    bricks : Bricks
        Of the finished model; supports that are taken out again are planned anew.
    edits : Edits
        All that it has now.
    unedited : Bricks
        What it would be without them.
    refused : tuple of str
        Why some of the new changes were not made, in sentences.
    dropped : int
        Earlier ones in whose place new ones came.
    """

    bricks: Bricks
    edits: Edits
    unedited: Bricks
    refused: tuple[str, ...] = ()
    dropped: int = 0


def edits_of(build: bpy.types.Collection) -> Edits:
    """Return the changes by hand of a build."""
    state = state_of(build)
    text, _ = state.edits
    return read_edits(text, load_catalogue()) if text else Edits((), state.scale, state.origin)


def outcomes_in(build: bpy.types.Collection) -> tuple[Outcome, ...]:
    """Return what the bricks of a build have of its changes by hand."""
    # as below: with the graphs of scipy, which nobody needs before
    from ..core.edits import Outcome, outcomes_of

    edits = edits_of(build)
    if not len(edits):
        return ()
    moved = edits.moved_to(state_of(build).scale, state_of(build).origin)
    if moved is None:
        return tuple(Outcome(each, "the model has another size now") for each in edits.edits)
    return outcomes_of(_final(build), load_catalogue(), moved.edits, {})


def change(build: bpy.types.Collection, new: Sequence[Edit]) -> Changed:
    """Make changes in the bricks of a build.

    Parameters
    ----------
    build : bpy.types.Collection
    new : sequence of Edit
        In its grid.

    Returns
    -------
    Changed

    Raises
    ------
    EditError
        None of them can be made, or the model has half studs.
    BuildError
        The build is damaged.
    """
    from ..core.edits import apply_edits

    check_whole(build)
    catalogue, bricks, (edits, unedited) = load_catalogue(), _final(build), _kept(build)
    if bricks.half is not None:
        raise EditError(
            "This model has half studs, but changes by hand need one grid: turn Half studs off and legorize it again."
        )
    rules = rules_of([*edits.edits, *new], catalogue)
    earlier = [each for each, rule in zip(edits.edits, rules, strict=False) if rule.by < len(edits)]
    made, refused = apply_edits(bricks, catalogue, [*earlier, *new])
    told = [
        f"Not done: {each.told(catalogue)}, because {refused[number]}."
        for number, each in enumerate(new, start=len(earlier))
        if number in refused
    ]
    if len(told) == len(new):
        raise EditError(told[0] if told else "Nothing is picked: click on a brick first.")
    # what was refused takes no place
    wanted = [*edits.edits, *(each for number, each in enumerate(new, start=len(earlier)) if number not in refused)]
    left = [each for each, rule in zip(wanted, rules_of(wanted, catalogue), strict=True) if rule.by < 0]
    return Changed(made, replace(edits, edits=tuple(left)), unedited, tuple(told), len(wanted) - len(left))


def without(build: bpy.types.Collection, numbers: Sequence[int]) -> Changed:
    """Take changes back: all others are made anew in the bricks as they were before any.

    Parameters
    ----------
    build : bpy.types.Collection
    numbers : sequence of int
        Which ones, from 0.

    Returns
    -------
    Changed

    Raises
    ------
    BuildError
        The build is damaged.
    """
    from ..core.edits import apply_edits

    check_whole(build)
    edits, gone = edits_of(build), set(numbers)
    left = replace(edits, edits=tuple(each for number, each in enumerate(edits.edits) if number not in gone))
    moved = left.moved_to(state_of(build).scale, state_of(build).origin)
    if moved is None:
        # none of them was made
        return Changed(_final(build), left, _final(build))
    unedited = _kept(build)[1]
    return Changed(apply_edits(unedited, load_catalogue(), moved.edits)[0], moved, unedited)


def touching(build: bpy.types.Collection, rows: Sequence[int]) -> list[int]:
    """Return the numbers of the changes that are about cells of some bricks of a build, from 0."""
    catalogue, bricks = load_catalogue(), read_bricks(build)
    parts = [(catalogue.parts[bricks.part[row]].number, row) for row in rows]
    cells = set[tuple[int, int, int]]()
    for number, row in parts:
        x, y, z = bricks.corner[row].tolist()
        cells |= Edit("delete", number, int(bricks.turn[row]), (x, y, z), 0).cells(catalogue)
    return [number for number, each in enumerate(edits_of(build).edits) if not cells.isdisjoint(each.cells(catalogue))]


def show_changed(
    scene: bpy.types.Scene,
    build: bpy.types.Collection,
    changed: Changed,
    *,
    name: str,
    detail: Detail,
    stability: Stability | None,
) -> bpy.types.Collection:
    """Show a build after changes, in the place of what it was.

    Parameters
    ----------
    scene : bpy.types.Scene
    build : bpy.types.Collection
        As it was.
    changed : Changed
    name : str
        Of the model.
    detail : {"low", "high"}
    stability : Stability or None
        Of the bricks, where it was tested.

    Returns
    -------
    bpy.types.Collection
        It does not know its steps: they are planned anew when all changes are made.
    """
    state, kept = state_of(build), KeptView.of([build])
    assembly, place = Assembly(changed.bricks, load_catalogue()), (state.origin, state.scale, state.mm_per_unit)
    model = Model(assembly, *place, stability=stability, wanted=surface_of(build))
    settings, colours = state.settings, found_colours(build)
    source = Source(name, sources_of(build), notes=state.notes)
    shown = show_build(scene, model, source, detail=detail, replaces=[build])
    state_of(shown).keep_settings(settings)
    keep_found_colours(shown, colours)
    text = edits_text(changed.edits) if len(changed.edits) else ""
    state_of(shown).edits = (text, bricks_text(changed.unedited))
    if kept is not None:
        kept.show(scene, shown)
    return shown


def _final(build: bpy.types.Collection) -> Bricks:
    """Return the bricks that stay in a build."""
    bricks = read_bricks(build)
    return bricks.take(bricks.role != Role.SUPPORT_OUTSIDE)


def _kept(build: bpy.types.Collection) -> tuple[Edits, Bricks]:
    """Return the changes of a build and its bricks without any, which are those that it has where there are none."""
    edits, state = edits_of(build), state_of(build)
    moved = edits.moved_to(state.scale, state.origin)
    if moved is None:
        raise EditError(OTHER_SIZE)
    _, unedited = state.edits
    if not unedited:
        return moved, _final(build)
    return moved, _without_collisions(read_bricks_text(unedited, state.part_numbers, load_catalogue()))


def _without_collisions(bricks: Bricks) -> Bricks:
    """Leave out pillars that stand where bricks were before an edit."""
    graph = Assembly(bricks, load_catalogue()).graph
    if not graph.collisions:
        return bricks
    pillar = np.isin(bricks.role, SUPPORTS)
    owner = Assembly(bricks.take(~pillar), load_catalogue()).graph.owner
    kept = [
        row
        for row in np.flatnonzero(pillar).tolist()
        if not (_in_cells(bricks.take(np.array([row])), owner) != NOBODY).any()
    ]
    return bricks.take(np.sort([*np.flatnonzero(~pillar).tolist(), *kept]).astype(np.intp))


def _in_cells(brick: Bricks, owner: np.ndarray) -> np.ndarray:
    """Return what fills the cells of a brick."""
    own = Assembly(brick, load_catalogue()).graph.owner != NOBODY
    low = tuple(slice(0, min(one, other)) for one, other in zip(own.shape, owner.shape, strict=True))
    return owner[low][own[low]]
