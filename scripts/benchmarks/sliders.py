"""What a large model takes in a scene, and how quickly its sliders answer; Blender's module is needed here."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Final, Literal

import bpy
import numpy as np

from legorize_addon.core.building.moves import Action, Moves
from legorize_addon.core.building.steps import Kind, Steps, Submodel
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks, Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.scene.collections import show_build
from legorize_addon.scene.model import Model, Source
from legorize_addon.scene.section import AXES, Section
from legorize_addon.view.steps import explode
from legorize_addon.view.visibility import cut_away, roles_shown, show_layers, show_role, show_steps
from scripts.benchmarks.tables import Row, Table

LIMIT: Final = 50.0
"""Goal for each slider in ms, on the wall and of the processor."""

SCENE: Final = 3.0
"""Goal for the making of the scene in CPU seconds."""

FILE: Final = 30.0
"""Goal for the file in MB, as Blender writes it by default."""

MOVES: Final = 10
LAYERS: Final = 60
ROLES: Final = (Role.SHELL, Role.INSIDE, Role.PLATE, Role.OFFSET, Role.SUPPORT_OUTSIDE)
STEPS_A_LAYER: Final = 3
BREADTH: Final = 200
"""Studs along x and y."""


def measure(*, bricks: int) -> list[Table]:
    """Return what the scene takes, and the time of moves of each slider, with all that Blender evaluates after them.

    Parameters
    ----------
    bricks : int
        Number of bricks of the model.

    Returns
    -------
    list of Table
        The scene, and a row for each slider: ms on the wall, and CPU ms of all threads together.
    """
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    model = large_model(bricks)
    large = Model(Assembly(model, load_catalogue()), (0.0, 0.0, 0.0), 1.0, 1.0, steps=steps_of(model))
    before, start = _resident(), time.process_time()
    build = show_build(scene, large, Source("large"))
    bpy.context.view_layer.update()
    made: Row = {
        "cpu_seconds": time.process_time() - start,
        "mb_of_memory": _resident() - before,
        "mb_of_file": _saved(),
    }
    made["goal_met"] = made["cpu_seconds"] <= SCENE and made["mb_of_file"] <= FILE
    tops = [1 + move * 37 % LAYERS for move in range(MOVES)]
    rows = [_row("top layer", [milliseconds(lambda top=top: show_layers(scene, build, top)) for top in tops])]
    single = [milliseconds(lambda top=top: show_layers(scene, build, top, single=True)) for top in tops]
    rows.append(_row("only this layer", single))
    show_layers(scene, build, LAYERS)
    rows += [_section_row(build, axis, f"section {axis}") for axis in AXES]
    cut_away(build, Section())
    ways = [move / MOVES for move in range(1, MOVES + 1)]
    rows.append(_row("explode", [milliseconds(lambda way=way: explode(build, way)) for way in ways]))
    explode(build, 0.0)
    show_steps(build, 1)
    bpy.context.view_layer.update()
    steps = [1 + move * 37 % (LAYERS * STEPS_A_LAYER) for move in range(1, MOVES + 1)]
    rows.append(_row("step", [milliseconds(lambda step=step: show_steps(build, step)) for step in steps]))
    show_steps(build, 0)
    bpy.context.view_layer.update()
    for what, role in (("a role's switch", next(iter(roles_shown(build)))), ("supports", Role.SUPPORT_OUTSIDE)):
        ways = (False, True) * (MOVES // 2)
        switched = [milliseconds(lambda on=on, role=role: show_role(build, role, visible=on)) for on in ways]
        rows.append(_row(what, switched))
    # as after a build, which hides them
    show_role(build, Role.SUPPORT_OUTSIDE, visible=False)
    bpy.context.view_layer.update()
    rows += [_section_row(build, axis, f"section {axis} without supports") for axis in AXES]
    cut_away(build, Section())
    show_role(build, Role.SUPPORT_OUTSIDE, visible=True)
    where = f"at {bricks} bricks in Blender {bpy.app.version_string}"
    return [
        Table("scene", f"The scene {where}: within {SCENE:.0f} s, a file within {FILE:.0f} MB", (made,)),
        Table("sliders", f"Sliders {where}: median within {LIMIT:.0f} ms", tuple(rows)),
    ]


def _resident() -> float:
    """Return the memory of this process in MB."""
    with Path("/proc/self/statm").open(encoding="ascii") as file:
        return int(file.read().split()[1]) * 4096 / 1e6


def _saved() -> float:
    """Return the size in MB of the file that Blender writes."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "large.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=False, copy=True)
        return path.stat().st_size / 1e6


def large_model(n: int) -> Bricks:
    """Return bricks as a large model has them: every role in every layer, 36 of 144 kinds in each, in two pieces."""
    rng = np.random.default_rng(0)
    layer = np.sort(np.arange(n) % LAYERS)
    return Bricks(
        part=rng.integers(0, 12, n).astype(np.int16),
        corner=np.column_stack([*rng.integers(0, BREADTH, (2, n)), 3 * layer]).astype(np.int32),
        turn=rng.integers(0, 4, n).astype(np.uint8),
        colour=load_catalogue().codes[(layer // 5 + rng.integers(0, 3, n)) % 12],
        role=rng.choice(np.array(ROLES, dtype=np.uint8), n),
        piece=(2 * layer // LAYERS).astype(np.int16),
        step=np.sort(layer * STEPS_A_LAYER + rng.integers(0, STEPS_A_LAYER, n)).astype(np.int32),
    )


def steps_of(model: Bricks) -> Steps:
    """Return how the bricks of a model are placed, by their steps."""
    n = len(model)
    moves = Moves(
        action=np.full(n, Action.PLACE, dtype=np.uint8),
        brick=np.arange(n, dtype=np.int32),
        piece=model.piece,
        submodel=model.piece.astype(np.int32),
        pressed=np.zeros(n, dtype=bool),
        step=model.step,
    )
    rows = [np.flatnonzero(model.piece == piece) for piece in range(int(model.piece.max()) + 1)]
    kinds = [Kind.MAIN, *(Kind.PIECE for _ in rows[1:])]
    found = (Submodel(turn, kinds[turn], min(turn, 1) - 1, turn, own, turn) for turn, own in enumerate(rows))
    return Steps(moves, tuple(found))


def milliseconds(move: Callable[[], None]) -> tuple[float, float]:
    """Return the time on the wall, and of the processor, of a move and of all that Blender evaluates after it."""
    start, begun = time.perf_counter(), time.process_time()
    move()
    bpy.context.view_layer.update()
    return 1e3 * (time.perf_counter() - start), 1e3 * (time.process_time() - begun)


def _section_row(build: bpy.types.Collection, axis: Literal["x", "y", "z"], name: str) -> Row:
    """Move a section along an axis."""
    cuts = [Section(axis, 0.1 + 0.8 * move / MOVES) for move in range(MOVES)]
    return _row(name, [milliseconds(lambda cut=cut: cut_away(build, cut)) for cut in cuts])


def _row(slider: str, taken: list[tuple[float, float]]) -> Row:
    wall, cpu = zip(*taken, strict=True)
    return {
        "slider": slider,
        "median_ms": median(wall),
        "most_ms": max(wall),
        "median_cpu_ms": median(cpu),
        "goal_met": max(median(wall), median(cpu)) <= LIMIT,
    }
