"""Legorize many models, each with many settings.

::

    python3 scripts/run.py python scripts/batch.py FOLDER --out OUT --width 24 48 --plates none pays
    ... --grid grid.toml --with "--render --instructions" --jobs 4
    ... --dask tcp://127.0.0.1:8786

Every model of FOLDER (images where there are no meshes) is built with every
combination of the given values. Each run is a process of its own, so that none
can end the others. OUT gets ``runs/MODEL/SETTINGS`` with the files of each,
``summary.csv``, ``summary.json`` and ``summary.html`` with a picture of each, and
``journal.jsonl``. A run that is complete, of the same files, settings and version,
is never done twice: the same command goes on where it was stopped.

Exit status: 0 all runs are there and passed every check; 2 all are there, but
checks failed; 1 some failed, or nothing was done; 130 stopped.
"""

from __future__ import annotations

import argparse
import os
import shlex
import sys
import tomllib
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

try:
    from legorize_addon.core.errors import LegorizeError, SettingsError
    from legorize_addon.core.setting import help_text
    from legorize_addon.core.settings import Settings, choices, setting_type
    from scripts.batches.crew import Line, results_of, stopping, usual_jobs
    from scripts.batches.plan import check_grid, models_in, program_of, read_grid, runs_of, tasks_of
    from scripts.batches.table import rows_of, write_tables
    from scripts.batches.work import Result
except ModuleNotFoundError as missing:
    print(f"The Python package {missing.name} is missing: run it by python3 scripts/run.py python.", file=sys.stderr)
    sys.exit(1)

YES = {"yes": True, "no": False}


def main(arguments: Sequence[str]) -> int:
    """Do a batch and return the exit status."""
    options = vars(parser().parse_args(arguments))
    folder, out = (Path(options.pop(name)) for name in ("folder", "out"))
    try:
        return batch(folder, out, options)
    except LegorizeError as error:
        print(error, file=sys.stderr)
        return 1


def parser() -> argparse.ArgumentParser:
    """Return the parser; each setting takes one value or more."""
    made = argparse.ArgumentParser(
        prog="batch.py", description="Legorize many models, each with many settings.", allow_abbrev=False
    )
    made.add_argument("folder", metavar="FOLDER", help="folder with models, searched to its depth")
    made.add_argument("--out", metavar="OUT", required=True, help="folder for all results; the same to go on")
    made.add_argument("--grid", metavar="FILE", help="JSON or TOML file: settings, each with a value or a list of them")
    made.add_argument(
        "--with", dest="flags", metavar="FLAGS", default="", help='more flags for all runs, as "--render"'
    )
    made.add_argument("--jobs", type=int, default=usual_jobs(), help="local processes at once (default: all cores)")
    made.add_argument("--dask", metavar="ADDRESS", help="scheduler of a Dask cluster that sees the same folders")
    made.add_argument("--blender", metavar="PROGRAM", help="Blender program to run (default: this Python's module bpy)")
    for entry in fields(Settings):
        kind, words = setting_type(entry), choices(entry)
        given: dict[str, Any] = {"choices": words} if words else {"type": kind}
        if kind is bool:
            given = {"choices": tuple(YES)}
        text = help_text(entry).replace("%", "%%")
        made.add_argument(f"--{entry.name.replace('_', '-')}", nargs="+", default=argparse.SUPPRESS, help=text, **given)
    return made


def batch(folder: Path, out: Path, options: dict[str, Any]) -> int:
    """Plan, do and tell."""
    flags, grid_file, jobs, dask, blender = (options.pop(name) for name in ("flags", "grid", "jobs", "dask", "blender"))
    grid = read_grid(Path(grid_file)) if grid_file else {}
    grid |= {name: [YES.get(value, value) for value in values] for name, values in options.items()}
    check_grid(grid)
    if jobs < 1:
        raise SettingsError(f"--jobs is {jobs}: give a number of processes.")
    out = out.resolve()
    runs = runs_of(models_in(folder, out), folder, grid, shlex.split(flags))
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise SettingsError(f"{out} cannot be made ({error.strerror}): choose another folder.") from error
    stop = out / f".stop-{os.getpid()}"
    program = program_of(blender, ROOT / "scripts" / "legorize.py")
    tasks = tasks_of(runs, out, program=program, version=version(), stop=stop)
    results, line = dict[str, Result](), Line(len(tasks))
    with stopping(stop):
        for result in results_of(tasks, jobs=jobs, dask=dask):
            results[result.name] = result
            line(result)
    line.end()
    stopped = stop.exists()
    stop.unlink(missing_ok=True)
    rows = rows_of(runs, tasks, results)
    write_tables(rows, out, f"Batch of {folder.resolve().name}")
    return told(rows, out, stopped=stopped)


def told(rows: Sequence[dict[str, Any]], out: Path, *, stopped: bool) -> int:
    """Print what failed and the totals; return the exit status."""
    for row in rows:
        if row["status"] in ("failed", "checks failed"):
            print(f"{row['folder']}: {row['status']}: {row['sentence']}", file=sys.stderr)
    count = {
        status: sum(row["status"] == status for row in rows) for status in ("ok", "checks failed", "failed", "stopped")
    }
    kept = sum(row["done"] == "kept" for row in rows)
    parts = [f"{number} {status}" for status, number in count.items() if number]
    print(f"{len(rows)} runs: {', '.join(parts)}; {kept} were complete before. Table: {out / 'summary.html'}")
    if stopped:
        return 130
    if count["failed"] or count["stopped"]:
        return 1
    return 2 if count["checks failed"] else 0


def version() -> str:
    """Return the version of the add-on."""
    return str(tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))["version"])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
