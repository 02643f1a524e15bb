"""What was built, in plain numbers and words, for ``report.json``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any, Final, Protocol

import numpy as np

from .catalogue import Catalogue, footprint
from .connection import Connection
from .ldraw import ldraw_matrix
from .mesh import Repairs, TriangleMesh
from .model import Bricks, Role, UnitGrid
from .settings import Settings
from .shopping import PartsList, count_parts, masses, not_made, pick_a_brick_csv

SCHEMA: Final = 1
"""Version of the keys; raised when one of them changes its meaning."""


class Built(Protocol):
    """What the report reads of a finished build."""

    # properties, because the members of a frozen dataclass can only be read
    @property
    def settings(self) -> Settings:
        """What the user chose."""

    @property
    def mesh(self) -> TriangleMesh:
        """The mesh as it was legorized, scaled and repaired."""

    @property
    def repairs(self) -> Repairs:
        """What was mended on it."""

    @property
    def scale(self) -> float:
        """Model mm per world mm."""

    @property
    def grid(self) -> UnitGrid:
        """The unit bricks before hollowing."""

    @property
    def bricks(self) -> Bricks:
        """The layout."""

    @property
    def connection(self) -> Connection:
        """How the bricks hold together."""

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences for the user."""

    @property
    def timings(self) -> Mapping[str, float]:
        """Seconds by stage."""


def report(build: Built, catalogue: Catalogue, *, version: str, mm_per_unit: float) -> dict[str, Any]:
    """Describe a build.

    Parameters
    ----------
    build : Built
        A finished build.
    catalogue : Catalogue
        Its parts and colours.
    version : str
        Version of the add-on.
    mm_per_unit : float
        World mm per unit of length in the scene the mesh came from.

    Returns
    -------
    dict
        Strings, numbers, lists and dictionaries only, ready for ``json.dumps``.
        ``mesh_to_ldraw`` is the row-major 4 x 4 transform from coordinates of
        that scene to LDU; ``hollow_ratio`` the share of the model's cells that
        no brick fills, supports excluded.

    Raises
    ------
    BuildError
        A brick has a colour that is not in the catalogue.
    """
    parts = count_parts(build.bricks, catalogue)
    _, no_element = pick_a_brick_csv(parts, catalogue)
    return {
        "schema": SCHEMA,
        "version": version,
        "seed": build.settings.seed,
        "settings": asdict(build.settings),
        "input": _input(build),
        "mesh_to_ldraw": ldraw_matrix(build.grid.origin, build.scale, mm_per_unit).tolist(),
        "scale": build.scale,
        "grid": _grid(build.grid),
        "counts": _counts(build, catalogue, parts),
        "mass_g": round(float(masses(parts, catalogue).sum()), 2),
        "hollow_ratio": round(1 - _filled(build.bricks, catalogue) / int(build.grid.solid.sum()), 4),
        "connection": _connection(build.connection),
        "unavailable_part_colours": _pairs(not_made(parts, catalogue), catalogue),
        "unknown_elements": _pairs(no_element, catalogue),
        "timings_s": {stage: round(seconds, 4) for stage, seconds in build.timings.items()},
        "notes": list(build.notes),
    }


def _input(build: Built) -> dict[str, Any]:
    repairs = asdict(build.repairs)
    return {
        "triangles": len(build.mesh.faces),
        "images": len(build.mesh.images),
        "watertight": repairs.pop("watertight"),
        "repairs": repairs,
    }


def _grid(grid: UnitGrid) -> dict[str, int]:
    """Return the extent of the model in studs and layers."""
    layer, _, y, x = np.nonzero(grid.solid)
    return {"x": int(np.ptp(x)) + 1, "y": int(np.ptp(y)) + 1, "layers": int(np.ptp(layer)) + 1}


def _counts(build: Built, catalogue: Catalogue, parts: PartsList) -> dict[str, Any]:
    bricks = build.bricks
    by_part = np.bincount(parts.part, parts.count, len(catalogue.parts)).astype(int).tolist()
    by_colour = np.bincount(parts.colour, parts.count, len(catalogue.colours)).astype(int).tolist()
    plate = np.array([part.height == 1 for part in catalogue.parts])
    return {
        "bricks": len(bricks),
        "plates": int(plate[bricks.part].sum()),
        "support_outside": int((bricks.role == Role.SUPPORT_OUTSIDE).sum()),
        "support_inside": int((bricks.role == Role.SUPPORT_INSIDE).sum()),
        "unit_bricks_before": int(build.grid.solid.any(axis=1).sum()),
        "by_part": {part.number: n for part, n in zip(catalogue.parts, by_part, strict=True) if n},
        "by_colour": {str(colour.code): n for colour, n in zip(catalogue.colours, by_colour, strict=True) if n},
    }


def _filled(bricks: Bricks, catalogue: Catalogue) -> int:
    """Return the number of cells (stud squares, a plate high) that bricks of the model fill."""
    # a turn moves cells but keeps their number
    cells = np.array([len(footprint(part, 0)) * part.height for part in catalogue.parts])
    support = np.isin(bricks.role, (Role.SUPPORT_OUTSIDE, Role.SUPPORT_INSIDE))
    return int(cells[bricks.part[~support]].sum())


def _connection(connection: Connection) -> dict[str, int]:
    return {
        "components": connection.n_components,
        "floating": connection.n_floating,
        "collisions": connection.collisions,
    }


def _pairs(parts: PartsList, catalogue: Catalogue) -> dict[str, Any]:
    """Return how many bricks a parts list has, and its pairs."""
    pairs = [
        {"part": part.number, "colour": colour.code, "count": count} for part, colour, count in parts.entries(catalogue)
    ]
    return {"bricks": int(parts.count.sum()), "pairs": pairs}
