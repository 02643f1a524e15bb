"""What came of a batch: one table as CSV and JSON, and a page with a picture of each build."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any, Final

import numpy as np

from legorize_addon.core.errors import BuildError
from legorize_addon.core.files.single import replacing
from legorize_addon.core.instructions.canvas import Page
from legorize_addon.core.instructions.lattice import FRONT, Cells, look
from legorize_addon.core.instructions.lots import placed, rgb_of
from legorize_addon.core.instructions.picture import MM, Look, draw
from legorize_addon.core.instructions.svg import svg
from legorize_addon.core.ldraw.reader import read_ldraw
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.safe_text import csv_text

from .plan import Run
from .work import Result, Task

WIDE: Final = 120.0
"""mm of a picture at most."""

_FIGURES: Final = {
    "bricks": lambda facts: facts["counts"]["bricks"],
    "layers": lambda facts: facts["grid"]["layers"],
    "studs_x": lambda facts: facts["grid"]["x"],
    "studs_y": lambda facts: facts["grid"]["y"],
    "mass_g": lambda facts: facts["mass_g"],
    "components": lambda facts: facts["connection"]["components"],
    "floating": lambda facts: facts["connection"]["floating"],
    "verdict": lambda facts: facts["stability"]["verdict"],
    "steps": lambda facts: facts["building"]["steps"],
    "support_bricks": lambda facts: facts["supports"]["removed"],
    "cost": lambda facts: (facts.get("price") or {}).get("model"),
    "difference_from_afar": lambda facts: facts.get("mosaic", {}).get("difference_from_afar"),
    "cpu_s": lambda facts: round(sum(facts["timings_s"].values()), 2),
    "notes": lambda facts: len(facts["notes"]),
}

Row = dict[str, Any]


def rows_of(runs: Sequence[Run], tasks: Sequence[Task], results: Mapping[str, Result]) -> list[Row]:
    """Return a row for each run, with what its report says.

    Parameters
    ----------
    runs : sequence of Run
    tasks : sequence of Task
        The same in the same order.
    results : mapping of str to Result
        By name; runs that had not begun are missing.

    Returns
    -------
    list of dict
        All with the same keys. ``status`` is ok, checks failed, failed or stopped; ``done`` is built or kept.
    """
    varied = list(dict.fromkeys(name for run in runs for name in run.varied))
    return [_row(run, task, results.get(run.name), varied) for run, task in zip(runs, tasks, strict=True)]


def _row(run: Run, task: Task, result: Result | None, varied: Sequence[str]) -> Row:
    done = result.status if result else "stopped"
    row: Row = {"model": run.model.name, **{name: run.varied.get(name) for name in varied}}
    row |= {"status": done, "done": done, **dict.fromkeys(_FIGURES), "sentence": result.sentence if result else ""}
    row |= {"folder": f"runs/{run.name}", "picture": None}
    if done in ("built", "kept"):
        facts = json.loads((task.out / "report.json").read_text(encoding="utf-8"))
        row |= {name: figure(facts) for name, figure in _FIGURES.items()}
        row["status"] = "checks failed" if facts["failed_checks"] else "ok"
        row["sentence"] = " ".join(facts["failed_checks"])
        row["picture"] = _picture(task)
    return row


def _picture(task: Task) -> str:
    """Return the picture of a build, below the folder of the batch: its render, else a drawing that is made now."""
    render, root = task.out / "render.png", Path(task.root)
    if render.exists():
        return render.relative_to(root).as_posix()
    drawing, model = root / "pictures" / f"{task.name.replace('/', '--')}.svg", task.out / "model.ldr"
    if not drawing.exists() or drawing.stat().st_mtime_ns < model.stat().st_mtime_ns:
        drawing.parent.mkdir(exist_ok=True)
        _write(drawing, drawing_of(model.read_text(encoding="utf-8")))
    return drawing.relative_to(root).as_posix()


def drawing_of(text: str) -> str:
    """Return a picture of an LDraw model as SVG."""
    catalogue = load_catalogue()
    bricks = read_ldraw(text, catalogue).bricks
    n = len(bricks)
    seen = look(Cells.of(bricks, catalogue, FRONT), n)
    smooth = ~catalogue.studs[bricks.part]
    made = draw(seen, Look(rgb_of(bricks, catalogue), np.ones(n, dtype=bool), smooth=smooth))
    wide, high = (made.size * MM).tolist()
    scale = WIDE / max(wide, high)
    return svg(Page(wide * scale, high * scale, (placed(made, 0, 0, scale),))) + "\n"


def write_tables(rows: Sequence[Row], root: Path, title: str) -> None:
    """Write ``summary.csv``, ``summary.json`` and ``summary.html`` into the folder of a batch."""
    columns = list(rows[0])
    lines = [["" if row[name] is None else row[name] for name in columns] for row in rows]
    _write(root / "summary.csv", csv_text(columns, lines))
    _write(root / "summary.json", json.dumps(list(rows), indent=1, ensure_ascii=False) + "\n")
    _write(root / "summary.html", "\n".join(_page(rows, columns, title)) + "\n")


def _write(path: Path, text: str) -> None:
    """Write a file as a whole, or not at all."""
    try:
        with replacing(path) as new:
            new.write_text(text, encoding="utf-8", newline="")
    except OSError as error:
        raise BuildError(f"{path} cannot be written ({error.strerror}): choose another folder.") from error


_STYLE: Final = """
body { font: 14px/1.4 system-ui, sans-serif; margin: 2em; color: #222; }
table { border-collapse: collapse; } th, td { padding: .3em .7em; text-align: right; border-bottom: 1px solid #ddd; }
th { position: sticky; top: 0; background: #f4f4f4; } td:first-child, th:first-child, .text { text-align: left; }
img { width: 160px; height: 110px; object-fit: contain; } .failed { color: #b00; } .text { max-width: 28em; }
"""


_HEADS: Final = {"mass_g": "mass (g)", "cpu_s": "CPU (s)", "studs_x": "studs along x", "studs_y": "studs along y"}
"""What stands above columns, where it is not their name."""

_WORDS: Final = dict.fromkeys(("model", "status", "verdict"), ' class="text"')
"""Columns that are read from the left."""


def _cell(name: str, value: object) -> str:
    """Return a cell of the table on the page."""
    return f"<td{_WORDS.get(name, '')}>{'' if value is None else escape(str(value))}</td>"


def _page(rows: Sequence[Row], columns: Sequence[str], title: str) -> Iterator[str]:
    shown = [name for name in columns if name not in ("picture", "folder", "done", "sentence")]
    shown = [name for name in shown if any(row[name] is not None for row in rows)]
    yield f'<!DOCTYPE html>\n<html lang="en"><meta charset="utf-8"><title>{escape(title)}</title>'
    yield f"<style>{_STYLE}</style>"
    counts = {
        status: sum(row["status"] == status for row in rows) for status in ("ok", "checks failed", "failed", "stopped")
    }
    told = ", ".join(f"{count} {status}" for status, count in counts.items() if count)
    yield f"<h1>{escape(title)}</h1><p>{len(rows)} runs: {told}.</p>"
    yield (
        "<table><tr><th>picture</th>"
        + "".join(
            f"<th{_WORDS.get(name, '')}>{escape(_HEADS.get(name, name.replace('_', ' ')))}</th>" for name in shown
        )
        + "<th></th></tr>"
    )
    for row in rows:
        picture = f'<img loading="lazy" alt="" src="{escape(row["picture"])}">' if row["picture"] else ""
        # what was not built has no folder
        first = f'<td><a href="{escape(row["folder"])}/">{picture}</a></td>' if picture else "<td></td>"
        cells = "".join(_cell(name, row[name]) for name in shown)
        colour = "" if row["status"] == "ok" else ' class="failed"'
        yield f'<tr{colour}>{first}{cells}<td class="text">{escape(row["sentence"])}</td></tr>'
    yield "</table></html>"
