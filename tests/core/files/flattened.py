"""A multi-part document followed step by step, by rules of its own: what stands on each table, and what floats there.

Nothing of the product is used but the sizes of its parts: lines are read as text,
contacts are found cell by cell.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field

from tests.core.standing import CATALOGUE

SIZES = {f"{part.number}.dat": (part.length, part.width, part.height, part.corner) for part in CATALOGUE.parts}
IDENTITY = (1, 0, 0, 0, 1, 0, 0, 0, 1)


@dataclass
class Model:
    """One model of a document: its steps, each a list of lines, and what is hidden from which step on."""

    steps: list[list[tuple[str, tuple[int, ...], int]]] = field(default_factory=lambda: [[]])
    removed: dict[int, str] = field(default_factory=dict)


def read(text):
    """Return the models of a document by name, and the name of the first; each line with the step that hides it."""
    models, name, first, hide, group = {}, "", "", 0, ""
    groups = defaultdict(list)
    for line in text.splitlines():
        words = line.split()
        if words[:2] == ["0", "FILE"]:
            name = " ".join(words[2:]).lower()
            first = first or name
            models[name] = Model()
        elif words[1:2] == ["STEP"]:
            # as LeoCAD reads it: a turned view ends no step
            models[name].steps.append([])
        elif words[1:4] == ["!LEOCAD", "PIECE", "STEP_HIDE"]:
            hide = int(words[4])
        elif words[1:3] == ["MLCAD", "BTG"]:
            group = words[3]
        elif words[1:4] == ["!LPUB", "REMOVE", "GROUP"]:
            models[name].removed[len(models[name].steps)] = words[4].strip('"')
        elif words[:1] == ["1"]:
            numbers = tuple(round(float(word)) for word in words[2:14])
            models[name].steps[-1].append((words[14].lower(), numbers, hide))
            if group:
                groups[name, group].append(hide)
            hide, group = 0, ""
    for name, model in models.items():
        assert not model.steps[-1], "something comes after the last step"
        model.steps.pop()
        for step, removed in model.removed.items():
            # both programs take out the same
            assert set(groups[name, removed]) == {step}
    return models, first


def cells_of(reference, numbers):
    """Return the cells of a part: x and y in studs, z in plates."""
    length, width, height, corner = SIZES[reference]
    x, y, z, *matrix = numbers
    if corner:
        local = [(0, 0), (20, 0), (0, 20)]
    else:
        local = [(20 * i - 10 * (length - 1), 20 * j - 10 * (width - 1)) for i in range(length) for j in range(width)]
    places = ((x + matrix[0] * a + matrix[2] * b, z + matrix[6] * a + matrix[8] * b) for a, b in local)
    top = -y // 8
    return [(px // 20, pz // 20, top - 1 - k) for px, pz in places for k in range(height)]


def bricks_of(models, name, *, step=None, offset=(0, 0, 0)):
    """Return the cells of each brick that a model has after some steps, or in the end, those of sub-models with it."""
    model = models[name]
    step = len(model.steps) if step is None else step
    found = []
    for lines in model.steps[:step]:
        for reference, (x, y, z, *matrix), hide in lines:
            if hide and hide <= step:
                continue
            place = (x + offset[0], y + offset[1], z + offset[2])
            if reference in models:
                assert tuple(matrix) == IDENTITY
                found += bricks_of(models, reference, offset=place)
            else:
                found.append(cells_of(reference, (*place, *matrix)))
    return found


def floating(bricks):
    """Count the bricks that do not hang together, stud by stud, with one on the lowest plate of all."""
    owner = {cell: row for row, cells in enumerate(bricks) for cell in cells}
    assert sum(map(len, bricks)) == len(owner), "bricks overlap"
    if not owner:
        return 0
    ground = min(z for _, _, z in owner)
    near = defaultdict(set)
    for (x, y, z), row in owner.items():
        other = owner.get((x, y, z + 1), row)
        if other != row:
            near[row].add(other)
            near[other].add(row)
    agenda = {row for (_, _, z), row in owner.items() if z == ground}
    seen = set()
    while agenda:
        row = agenda.pop()
        seen.add(row)
        agenda |= near[row] - seen
    return len(bricks) - len(seen)


def afloat(text):
    """Count, over all steps of all models of a document, the bricks that float on their table at its end."""
    models, _ = read(text)
    return {
        (name, step): count
        for name, model in models.items()
        for step in range(1, len(model.steps) + 1)
        if (count := floating(bricks_of(models, name, step=step)))
    }
