"""A model in building order as one LDraw multi-part document.

The model, its pieces and its sub-assemblies are sub-models with steps of their
own; supports stand among the bricks, in the steps in which they are built.
LDraw itself has no command that takes something out again. Two programs have one:
LPub3D removes groups, LeoCAD hides parts from a step on.

References
----------
LDraw.org, "MPD Extension"; MLCad's ``GROUP``, ``MLCAD BTG`` and ``ROTSTEP``;
LPub3D's ``!LPUB REMOVE GROUP``; LeoCAD's ``!LEOCAD PIECE STEP_HIDE``.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..building import MAIN, Action, Step, Steps, Submodel, quarter_turns
from ..model import Assembly, Role
from ..safe_text import one_line
from ..units import PLATE_LDU, STUD_LDU
from .ldraw import LINE_END, MAIN_COLOUR, MATRICES, brick_lines, header


def write_mpd(assembly: Assembly, steps: Steps, *, name: str, title: str) -> str:
    """Write bricks as a multi-part document in building order.

    Parameters
    ----------
    assembly : Assembly
        The model and its supports.
    steps : Steps
        How they are built.
    name : str
        Name of the main model, "model.ldr"; "model-" is put before one that a
        sub-model has.
    title : str
        What the model shows.

    Returns
    -------
    str
        The text with CRLF line ends. Each step ends in one ``0 STEP`` of the
        model in which it is done, after ``0 ROTSTEP`` where what it puts on would be hidden
        behind the rest and after that: for LPub3D the two are one end, and LeoCAD knows the
        second alone. It begins with its number through all of them; sub-models that are built
        together are one, called for each.
    """
    return LINE_END.join([*_Document(assembly, steps, one_line(name), title).lines(), ""])


class _Document:
    """The lines of all models."""

    def __init__(self, assembly: Assembly, steps: Steps, name: str, title: str) -> None:
        bricks = self.bricks = assembly.bricks
        self.steps, self.title = steps, title
        self.brick_lines = brick_lines(assembly)
        self.kinds = np.column_stack([bricks.role, bricks.piece]).tolist()
        taken = {each.name for each in steps.submodels[1:]}
        self.name = f"model-{name}" if name.lower().removesuffix(".ldr") in taken else name
        self.of_submodel: dict[int, list[Step]] = {}
        for step in steps:
            for each in (*step.made, step.submodel):
                self.of_submodel.setdefault(each, []).append(step)
        self.hidden = self._hidden()
        self.turns = quarter_turns(steps, assembly).tolist()

    def lines(self) -> Iterator[str]:
        """Yield all lines, the main model first."""
        for submodel in self.steps.submodels:
            if submodel.like == submodel.number:
                yield from self._model(submodel)

    def _hidden(self) -> dict[int, tuple[int, int]]:
        """Return of each support that is taken out the step, and its place among the steps of its model, from 1."""
        return {
            row: (step.number, turn)
            for steps in self.of_submodel.values()
            for turn, step in enumerate(steps, start=1)
            if step.action == Action.REMOVE
            for row in step.bricks.tolist()
        }

    def _model(self, submodel: Submodel) -> Iterator[str]:
        main = submodel.number == MAIN
        name = self.name if main else f"{submodel.name}.ldr"
        yield f"0 FILE {name}"
        yield from header(name, self.title if main else f"{self.title}, {submodel.name}")
        kind: list[int] = []
        turned = 0
        own = set(submodel.rows.tolist())
        steps = self.of_submodel.get(submodel.number, [])
        for step in steps:
            yield f"0 // Step {step.number + 1}{_remark(step, self.steps.times(step, submodel.number))}"
            if step.action == Action.REMOVE:
                yield f'0 !LPUB REMOVE GROUP "{_group(step.number)}"'
            # equal ones are built in the same steps, and written once
            for row in [row for row in step.bricks.tolist() if row in own and step.action == Action.PLACE]:
                if kind != self.kinds[row]:
                    kind = self.kinds[row]
                    yield f"0 !LEGORIZE ROLE {Role(kind[0]).name} PIECE {kind[1]}"
                yield from self._brick(row)
            for number in step.joined:
                if self.steps.submodels[number].parent == submodel.number:
                    piece, written = (self.steps.submodels[each].piece for each in (number, self._written(number)))
                    if piece != written or (kind and kind[1] not in (0, piece)):
                        # what is written once for several pieces is told apart where it is put on
                        kind = [kind[0] if kind else int(Role.SHELL), piece]
                        yield f"0 !LEGORIZE ROLE {Role(kind[0]).name} PIECE {piece}"
                    yield self._call(number)
            turn = self.turns[step.number] if submodel.number == step.submodel else 0
            if turn:
                yield f"0 ROTSTEP 0 {90 * turn} 0 REL"
            elif turned:
                yield "0 ROTSTEP END"
            yield "0 STEP"
            turned = turn
        for step in steps:
            if step.action == Action.REMOVE:
                yield f"0 GROUP {sum(row in own for row in step.bricks.tolist())} {_group(step.number)}"
        yield "0 NOFILE"

    def _brick(self, row: int) -> Iterator[str]:
        if row in self.hidden:
            step, turn = self.hidden[row]
            yield f"0 !LEOCAD PIECE STEP_HIDE {turn}"
            yield f"0 MLCAD BTG {_group(step)}"
        yield self.brick_lines[row]

    def _call(self, number: int) -> str:
        """Return the line that puts a submodel where it belongs, wherever the one that is written stands."""
        first = self._written(number)
        x, y, z = (self._low(number) - self._low(first)).tolist() if first != number else (0, 0, 0)
        place = f"{round(x * STUD_LDU)} {round(-z * PLATE_LDU)} {round(y * STUD_LDU)}"
        return f"1 {MAIN_COLOUR} {place} {MATRICES[0]} {self.steps.submodels[first].name}.ldr"

    def _written(self, number: int) -> int:
        """Return the submodel that stands for one in the document."""
        return self.steps.submodels[number].like

    def _low(self, number: int) -> np.ndarray:
        rows = self.steps.all_rows(number)
        low: np.ndarray = (self.bricks.corner[rows] + self.bricks.shift[rows]).min(axis=0)
        return low


def _group(step: int) -> str:
    """Return the name of what is taken out in a step."""
    return f"supports-{step + 1}"


def _remark(step: Step, times: int) -> str:
    """Return the comment lines of a step."""
    if step.action == Action.REMOVE:
        return ": take these supports out"
    return (f", {times} times" if times > 1 else "") + (", pressed from below" if step.pressed else "")
