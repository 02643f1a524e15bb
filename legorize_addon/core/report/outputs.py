"""The text files of a build: their names and contents."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any, Final

from ..build import Build, Finished, Mosaic
from ..edits import edits_text
from ..errors import enough_memory
from ..files import build_order_csv, tiles_csv, write_ldr, write_mpd
from ..model import Assembly, Catalogue
from ..shopping import FORMATS, ShoppingList, list_texts, shopping_list
from .money import with_prices
from .ownership import missing_list
from .paper_tables import paper_tables

CERTAIN: Final = ("model.ldr", "model.mpd", "build_order.csv", "parts.csv", "report.json")
"""Files that every build has."""


@enough_memory()
def output_texts(build: Finished, catalogue: Catalogue, facts: dict[str, Any], title: str) -> dict[str, str]:
    """Return the contents of the text files by name.

    Lists of supports are there only if there are supports to buy, and a list
    that a shop reads only if it has something in it. The paper's tables are of
    models of meshes alone, the parts by tiles of mosaics that lie alone.
    """
    everything = Assembly(build.supports.bricks, catalogue)
    return {
        "model.mpd": write_mpd(everything, build.supports.steps, name="model.ldr", title=title),
        **list_texts(*wanted_lists(build, catalogue, title)),
        **later_texts(build, catalogue, facts, title),
    }


def later_texts(build: Finished, catalogue: Catalogue, facts: dict[str, Any], title: str) -> dict[str, str]:
    """Return those of the files, by name, that a scene keeps, since its bricks alone do not tell what is in them."""
    return {
        "model.ldr": write_ldr(build.supports.final_alone, name="model.ldr", title=title, follow="model.mpd"),
        "build_order.csv": _order(build, catalogue),
        "report.json": json.dumps(facts, indent=2, allow_nan=False) + "\n",
        **missing_texts(build, catalogue, title),
        **(_tables(build, catalogue, title) if isinstance(build, Build) else {}),
        **({"edits.json": edits_text(build.edits)} if isinstance(build, Build) and len(build.edits) else {}),
        **(
            {"tiles.csv": tiles_csv(Assembly(build.bricks, catalogue))}
            if isinstance(build, Mosaic) and not build.settings.standing
            else {}
        ),
    }


def _order(build: Finished, catalogue: Catalogue) -> str:
    supports = build.supports
    return build_order_csv(supports.steps, Assembly(supports.bricks, catalogue), by_hand=supports.by_hand)


def _tables(build: Build, catalogue: Catalogue, title: str) -> dict[str, str]:
    return {f"tables/{name}": table for name, table in paper_tables(build, catalogue, name=title).items()}


def wanted_lists(build: Finished, catalogue: Catalogue, title: str) -> tuple[ShoppingList, ShoppingList]:
    """Return what to buy for the finished model, and for the supports that are taken out of it again."""
    model, removed = (Assembly(bricks, catalogue) for bricks in (build.bricks, build.supports.removed))
    lists = (
        shopping_list(model, title=title, moves=len(build.supports.moves)),
        shopping_list(removed, title=f"{title}, supports", moves=0),
    )
    one, other = (replace(each, lots=with_prices(each.lots, build.prices, catalogue)) for each in lists)
    return one, other


def missing_texts(build: Finished, catalogue: Catalogue, title: str) -> dict[str, str]:
    """Return the lists of what is built but not owned, ``missing-parts.csv`` and so on; none if nothing is missing."""
    if build.owned is None:
        return {}
    everything = shopping_list(Assembly(build.supports.bricks, catalogue), title=f"{title}, missing", moves=0)
    wanted = missing_list(everything, build.owned, catalogue)
    wanted = replace(wanted, lots=with_prices(wanted.lots, build.prices, catalogue))
    return {f"missing-{kind.file}": kind.text(wanted) for kind in FORMATS if kind.has_any(wanted)}
