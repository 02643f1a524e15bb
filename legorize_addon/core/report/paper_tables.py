"""The paper's four tables of one model, as CSV.

References
----------
Paper, Table 1 (volume of each brick in each colour), Table 2 (bricks of supports),
Table 3 (hollow ratio, number of bricks, time) and Table 4 (weight and number of
support bricks).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ..build import Build
from ..model import SUPPORTS, Assembly, Bricks, Catalogue, Part, concatenate, footprint
from ..safe_text import csv_text, one_line
from ..shopping import count_lots
from .mesh_facts import hollow_ratio

LINE_END = "\r\n"


def paper_tables(build: Build, catalogue: Catalogue, *, name: str) -> dict[str, str]:
    """Return the tables by the names of their files.

    Parameters
    ----------
    build : Build
        A finished build.
    catalogue : Catalogue
        Its parts and colours.
    name : str
        Of the model, for the rows of tables 3 and 4.

    Returns
    -------
    dict of str to str
        ``table_1.csv`` to ``table_4.csv``; the second and the fourth are of models
        with supports alone. Percentages are of the volume of the model without
        its supports in the first, of all supports in the second. Seconds are those
        of the layout and of its verification. The fourth has a row for the supports
        that are taken out again, and one for those that stay.
    """
    support = np.isin(build.bricks.role, SUPPORTS)
    seconds = sum(
        build.timings.get(stage, 0.0) for stage in ("layout", "ties", "strengthening", "stability", "bracing")
    )
    line = (one_line(name), build.settings.layout, round(hollow_ratio(build), 4), len(build.bricks), round(seconds, 3))
    tables = {
        "table_1.csv": _volumes(build.bricks.take(~support), catalogue),
        "table_3.csv": _text(("model", "method", "hollow_ratio", "bricks", "seconds"), [line]),
    }
    supports = {"taken out": build.supports.removed, "stay": build.bricks.take(support)}
    there = {fate: bricks for fate, bricks in supports.items() if len(bricks)}
    if there:
        ways = " ".join(dict.fromkeys(piece.plan.way for piece in build.supports.pieces))
        tables["table_2.csv"] = _volumes(concatenate(list(there.values())), catalogue)
        tables["table_4.csv"] = _text(
            ("model", "method", "supports", "weight_g", "bricks"),
            [
                (one_line(name), ways, fate, round(float(catalogue.mass[bricks.part].sum()), 2), len(bricks))
                for fate, bricks in there.items()
            ],
        )
    return tables


def _volumes(bricks: Bricks, catalogue: Catalogue) -> str:
    """Return the number of each part in each colour, and its share of the volume in percent."""
    lots = count_lots(Assembly(bricks, catalogue))
    volumes = [_volume(lot.part) * lot.count for lot in lots]
    whole = max(sum(volumes), 1)
    rows = [
        (lot.part.number, lot.part.title, lot.colour.code, lot.colour.name, lot.count, round(100 * volume / whole, 4))
        for lot, volume in zip(lots, volumes, strict=True)
    ]
    return _text(("part", "title", "colour", "name", "count", "volume_percent"), rows)


def _volume(part: Part) -> int:
    """Return the cells of a part, a plate high."""
    return len(footprint(part, 0)) * part.height


def _text(columns: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    return csv_text(columns, rows, line_end=LINE_END)
