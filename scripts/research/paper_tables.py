"""The paper's Tables 1 to 4 of the same models in one run: ours, its own ways, and those that it compares with.

References
----------
Paper, Table 1 (volumes of bricks), Table 2 (volumes of support bricks), Table 3
(hollow ratio, number of bricks, time) and Table 4 (weight and number of support
bricks).
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Final

from legorize_addon.core.presets import preset_values
from legorize_addon.core.settings import Settings
from scripts.benchmarks.kept import Kept
from scripts.benchmarks.tables import Row, Table
from scripts.research.claims import claims
from scripts.research.layouts import manifest_version
from scripts.research.paper_case import FIELD, Case, Make, Options, in_bricks, parts

TITLES: Final = {
    "tables_1": "Table 1: volumetric percentages of the bricks, by part and colour; default, without supports",
    "tables_2": "Table 2: volumetric percentages of the support bricks as built",
    "tables_2_counts": "Table 2 in numbers of bricks",
    "tables_3": "Table 3: hollow ratio, bricks and CPU seconds of every method; grams and bricks against our rule",
    "tables_4": "Table 4: weight and number of support bricks by kind; models without supports are left out",
    "tables_4_built": "Supports of the finished build: those that are taken out, and those that stay",
    "tables_claim_figures": "What the claims need beside the tables",
    "tables_claims": "The paper's claims H1 to H13 as goals",
    "tables_run": "How it was measured",
}


def measure(paths: Sequence[Path], *, width: int, seed: int, repeats: int, minutes: float, out: Path) -> list[Table]:
    """Make all four tables.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    width : int
        Studs along the longer horizontal side.
    seed : int
        Of everything random.
    repeats : int
        Runs of each method, of which the fastest counts.
    minutes : float
        After which no part of a model is begun; 0 for no limit.
    out : Path
        For what is measured of each model part by part, which the next run of the same program takes over.

    Returns
    -------
    list of Table
        Of the models of which everything is measured; none if there was no time for any.
    """
    options = Options(width, seed, repeats)
    rows: dict[str, list[Row]] = {name: [] for name in TITLES}
    kept = Kept(out / "tables", minutes)
    for path in paths:
        for name, several in kept_parts(path, options, kept).items():
            rows[name] += several
    kept.tell_left()
    if not rows["tables_3"]:
        return []
    rows["tables_run"] = [run_facts(rows["tables_3"], options)]
    rows["tables_claims"] = claims(
        rows["tables_3"], rows["tables_1"], rows["tables_4"], rows["tables_claim_figures"], FIELD
    )
    return [Table(name, TITLES[name], tuple(same_columns(rows[name]))) for name in TITLES if rows[name]]


def run_facts(rows: Sequence[Row], options: Options) -> Row:
    """Return version, models and parameters of a run, and what its ways of building set that is not the default."""
    plain = asdict(Settings())
    ways = {"bricks_alone": asdict(in_bricks(options)), "as_published": preset_values("paper")}
    sets = {way: {name: value for name, value in each.items() if value != plain[name]} for way, each in ways.items()}
    return {
        "legorize": manifest_version(),
        "models": ", ".join(dict.fromkeys(str(row["model"]) for row in rows)),
        **asdict(options),
        **{way: ", ".join(f"{name} {value}" for name, value in each.items()) for way, each in sets.items()},
    }


def same_columns(rows: Sequence[Row]) -> list[Row]:
    """Return rows that all have the columns of all: a model has no supports of the kinds that it does not use."""
    columns = dict.fromkeys(name for row in rows for name in row)
    return [{name: row.get(name, 0) for name in columns} for row in rows]


def kept_parts(path: Path, options: Options, kept: Kept) -> dict[str, list[Row]]:
    """Return the rows of a model by table, each part measured now or before; none while a part is missing."""
    case = Case(path, options)
    start = f"{path.stem}-{options.width}-{options.seed}-{options.repeats}"
    made = [
        kept.row(f"{start}-{part}".replace("*", " star"), partial(_texts, f"{path.stem}, {part}", make))
        for part, make in parts(case).items()
    ]
    if not all(made):
        return {}
    found: dict[str, list[Row]] = {}
    for [each] in made:
        for name, text in each.items():
            found.setdefault(name, []).extend(case.start | row for row in json.loads(str(text)))
    one: Row = {name: value for row in found["tables_claim_figures"] for name, value in row.items()}
    return found | {"tables_3": against_first(found["tables_3"]), "tables_claim_figures": [one]}


def against_first(rows: Sequence[Row]) -> list[Row]:
    """Return rows of Table 3, and how much more each layout takes than the first one, ours with our rule."""

    def more(row: Row, name: str) -> float | None:
        return float(str(row[name])) - float(str(rows[0][name])) if row["tc_of"] == "layout" else None

    return [row | {"more_bricks": more(row, "nb"), "more_g": more(row, "mass_g")} for row in rows]


def _texts(told: str, make: Make) -> Row:
    """Return the rows of a part as JSON, by table."""
    print(told, file=sys.stderr, flush=True)
    return {name: json.dumps(made) for name, made in make().items()}
