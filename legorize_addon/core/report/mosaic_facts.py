"""What the report says of mosaics alone."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np

from ..build import Mosaic
from ..model import NOBODY, Assembly, Catalogue, Role
from ..mosaic import seen_from_afar


def facts_of_mosaic(mosaic: Mosaic, catalogue: Catalogue) -> dict[str, Any]:
    """Return the keys of the report that only mosaics have.

    Parameters
    ----------
    mosaic : Mosaic
    catalogue : Catalogue

    Returns
    -------
    dict
        ``input`` has the pixels of the image. ``mosaic`` has the studs of the image, of its border, and those covered;
        parts of the base; the mean CIEDE2000 difference to the image from afar; studs that were changed to join the
        base, its seams, and the parts that lie across them.
    """
    assembly, canvas = Assembly(mosaic.bricks, catalogue), mosaic.canvas
    base = (assembly.bricks.role == Role.INSIDE) & (not mosaic.settings.standing)
    numbers = Counter(catalogue.parts[part].number for part in assembly.bricks.part[base].tolist())
    facts = {
        "columns": canvas.columns,
        "rows": canvas.rows,
        "border": canvas.border,
        "covered": int(mosaic.goal.there.sum()),
        "base": dict(numbers),
        "difference_from_afar": round(seen_from_afar(mosaic.goal, mosaic.colour, catalogue), 3),
        "recoloured": mosaic.covered.changed,
        "covered_to_join": mosaic.covered.added,
        "standing": mosaic.settings.standing,
        **({} if mosaic.settings.standing else _seams(assembly)),
    }
    return {"input": {"pixels": list(mosaic.pixels)}, "mosaic": facts}


def _seams(assembly: Assembly) -> dict[str, int]:
    """Return how many pairs of parts of the base lie side by side, and how many parts lie across two or more."""
    graph, base = assembly.graph, assembly.bricks.role == Role.INSIDE
    ground = graph.owner[0]
    ends = ((ground[:, :-1], ground[:, 1:]), (ground[:-1], ground[1:]))
    pairs = np.concatenate([np.stack([one.ravel(), other.ravel()], axis=1) for one, other in ends])
    pairs = pairs[(pairs[:, 0] != pairs[:, 1]) & (pairs != NOBODY).all(axis=1)]
    lower, upper = graph.pairs.T
    held = np.bincount(upper[base[lower]], minlength=len(assembly))
    return {"seams": len(np.unique(np.sort(pairs, axis=1), axis=0)), "parts_across_seams": int((held > 1).sum())}
