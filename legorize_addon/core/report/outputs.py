"""The text files of a build: their names and contents."""

from __future__ import annotations

import json
from typing import Any, Final

from ..build import Build
from ..errors import enough_memory
from ..files import (
    PartsList,
    bricklink_xml,
    build_order_csv,
    count_parts,
    parts_csv,
    pick_a_brick_csv,
    rebrickable_csv,
    write_ldr,
    write_mpd,
)
from ..model import Assembly, Catalogue
from .paper_tables import paper_tables

CERTAIN: Final = ("model.ldr", "model.mpd", "build_order.csv", "parts.csv", "report.json")
"""Files that every build has."""


@enough_memory()
def output_texts(build: Build, catalogue: Catalogue, facts: dict[str, Any], title: str) -> dict[str, str]:
    """Return the contents of the text files by name.

    Lists of supports are there only if there are supports to buy, and a list
    that a shop reads only if it has something in it.
    """
    parts, supports = (count_parts(Assembly(bricks, catalogue)) for bricks in (build.bricks, build.supports.removed))
    everything = Assembly(build.supports.bricks, catalogue)
    return {
        "model.ldr": write_ldr(build.supports.final_alone, name="model.ldr", title=title, follow="model.mpd"),
        "model.mpd": write_mpd(everything, build.supports.steps, name="model.ldr", title=title),
        "build_order.csv": _order(build, catalogue),
        "report.json": json.dumps(facts, indent=2, allow_nan=False) + "\n",
        **_lists("", parts, catalogue),
        **_lists("support-", supports, catalogue),
        **{f"tables/{name}": table for name, table in paper_tables(build, catalogue, name=title).items()},
    }


def _order(build: Build, catalogue: Catalogue) -> str:
    supports = build.supports
    return build_order_csv(supports.steps, Assembly(supports.bricks, catalogue), by_hand=supports.by_hand)


def _lists(prefix: str, parts: PartsList, catalogue: Catalogue) -> dict[str, str]:
    """Return the lists of what to buy, for people and for the shops."""
    if not len(parts):
        return {}
    elements, left_out = pick_a_brick_csv(parts, catalogue)
    lists = {
        "parts.csv": parts_csv(parts, catalogue),
        "bricklink.xml": bricklink_xml(parts, catalogue),
        "rebrickable.csv": rebrickable_csv(parts, catalogue),
        **({"pick-a-brick.csv": elements} if len(left_out) < len(parts) else {}),
    }
    return {f"{prefix}{name}": text for name, text in lists.items()}
