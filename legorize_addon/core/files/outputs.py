"""The text files of a build: their names and contents."""

from __future__ import annotations

import json
from typing import Any

from .. import ldraw, shopping
from ..build import Build
from ..building.order_file import build_order_csv
from ..catalogue import Catalogue
from ..ldraw_document import write_mpd
from ..tables import paper_tables


def texts(build: Build, catalogue: Catalogue, facts: dict[str, Any], title: str) -> dict[str, str]:
    """Return the contents of the text files by name."""
    parts, supports = (shopping.count_parts(bricks, catalogue) for bricks in (build.bricks, build.supports.removed))
    return {
        "model.ldr": ldraw.write_ldr(build.bricks, catalogue, name="model.ldr", title=title),
        "model.mpd": write_mpd(build.supports.bricks, catalogue, name="model.ldr", title=title),
        "build_order.csv": build_order_csv(build.supports.moves, build.supports.bricks, catalogue),
        "report.json": json.dumps(facts, indent=2, allow_nan=False) + "\n",
        "parts.csv": shopping.parts_csv(parts, catalogue),
        "bricklink.xml": shopping.bricklink_xml(parts, catalogue),
        "rebrickable.csv": shopping.rebrickable_csv(parts, catalogue),
        "pick-a-brick.csv": shopping.pick_a_brick_csv(parts, catalogue)[0],
        "support-parts.csv": shopping.parts_csv(supports, catalogue),
        "support-bricklink.xml": shopping.bricklink_xml(supports, catalogue),
        **{f"tables/{name}": table for name, table in paper_tables(build, catalogue, name=title).items()},
    }
