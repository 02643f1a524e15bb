"""The files that show the method: maps of trajectories and hollowing, the tree of the loops, models of unit bricks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ..build import Draft
from ..files import write_ldr
from ..instructions import layer_files
from ..model import Assembly, Bricks, Catalogue
from ..progress import Progress, part, silent
from .hierarchy import hierarchy_text
from .hollowing_maps import hollowing_maps
from .sheet import Sheet
from .trajectory_maps import Shown, trajectory_maps
from .unit_models import hollowed_model, initial_model

TREE: Final = "tree.txt"


def method_files(
    draft: Draft,
    supports: Assembly | None,
    *,
    title: str,
    shown: Shown,
    catalogue: Catalogue,
    progress: Progress = silent,
) -> Iterator[tuple[str, str]]:
    """Yield the names and contents of all files, those of maps with their folder.

    Parameters
    ----------
    draft : Draft
    supports : Assembly or None
        Bricks that are taken out again, to be drawn beside the cells.
    title : str
        Name of the model.
    shown : {"sides", "colours"}
        How trajectories are drawn.
    catalogue : Catalogue
    progress : Progress

    Yields
    ------
    name : str
        ``tree.txt``, ``unit-bricks.ldr``, ``hollowing.ldr``, ``trajectories/001.svg`` and
        ``hollowing/001.svg``, the last two numbered by layer from the lowest one drawn.
    text : str
    """
    cut, grid = draft.cut, draft.grid
    yield TREE, hierarchy_text(draft.trajectories, slice_titles(draft), catalogue)
    models = {"unit-bricks": initial_model(grid, catalogue), "hollowing": hollowed_model(draft.hollow, catalogue)}
    for name, bricks in models.items():
        yield f"{name}.ldr", _ldr(bricks, name, title, catalogue)
    sheet = Sheet.of(*grid.colour.shape[:1:-1])
    maps = {
        "trajectories": trajectory_maps(
            draft.trajectories, cut.layer, cut.plate, origin=grid.origin[:2], sheet=sheet, catalogue=catalogue,
            shown=shown,
        ),
        "hollowing": hollowing_maps(grid, draft.hollow, supports, sheet=sheet, catalogue=catalogue),
    }  # fmt: skip
    for number, (folder, pages) in enumerate(maps.items()):
        told = part(progress, number / len(maps), (number + 1) / len(maps))
        for row, (name, text) in enumerate(layer_files(pages)):
            told(folder, min(row / len(grid.colour), 1.0))
            yield f"{folder}/{name}", text


def slice_titles(draft: Draft) -> list[str]:
    """Return what each slice is called: its layer and plate from 1, and its height above the ground."""
    cut = draft.cut
    heights = (cut.slices.heights - draft.grid.origin[2]).tolist()
    places = zip(cut.layer.tolist(), cut.plate.tolist(), heights, strict=True)
    return [f"Layer {layer + 1}, plate {plate + 1}, at {height:.1f} mm" for layer, plate, height in places]


def _ldr(bricks: Bricks, name: str, title: str, catalogue: Catalogue) -> str:
    return write_ldr(Assembly(bricks, catalogue), name=f"{name}.ldr", title=f"{title}, {name.replace('-', ' ')}")
