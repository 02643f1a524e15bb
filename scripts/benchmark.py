"""Measure Legorize against references, in the same run on the same machine.

::

    python scripts/benchmark.py slicing   [MESH ...] [--out DIR]   against trimesh and shapely
    python scripts/benchmark.py units     [MESH ...] [--out DIR]   against trimesh, the exact rule, dense sampling
    python scripts/benchmark.py pipeline  [MESH ...] [--out DIR]   every stage, every result
    python scripts/benchmark.py budget    [MESH ...] [--out DIR]   estimates against what builds take
    python scripts/benchmark.py detail    [MESH ...] [--judge DIR] what plates gain and cost
    python scripts/benchmark.py hollowing [MESH ...] [--out DIR]   against a shell of two cells
    python scripts/benchmark.py stability [MESH ...] [--out DIR]   against HiGHS, and the StableLego cases
    python scripts/benchmark.py goals     [MESH ...] [--out DIR]   every goal of the layout, in one table
    python scripts/benchmark.py layouts   [MESH ...] [--peer PY]   against the layouts of the field, and a peer
    python scripts/benchmark.py supports  [MESH ...] [--out DIR]   trees, columns and beams against full columns
    python scripts/benchmark.py building  [MESH ...] [--out DIR]   building orders, followed from their files
    python scripts/benchmark.py judge     [MESH ...] --judge DIR   an external judge, on our bricks and on a peer's
    python scripts/benchmark.py kills    [MESH] [--runs N] [--out DIR] killed runs: old or new results, nothing left
    python scripts/benchmark.py fuzz     [--cases N] [--seed S]    random bodies with random settings, within limits
    python scripts/benchmark.py sliders  [--bricks N] [--out DIR] what Blender takes to show layers and sections

Without a mesh the bundled sample is measured; ``--models DIR`` takes all model
files of a folder. The packages of the dependency group ``checks`` are needed,
and Blender's module for the sliders alone. Tables are printed as Markdown and
written as CSV and JSON. Times are CPU seconds of all threads, the least of
several runs, but of the sliders those on the wall; compare only those of one
run, and trust the ratios more than the seconds.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

ROOT: Final = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from legorize_addon.core.errors import LegorizeError  # noqa: E402 - found through the line above
from scripts.benchmarks import (  # noqa: E402
    budget,
    building,
    detail,
    fuzz,
    goals,
    hollowing,
    judge,
    kills,
    layouts,
    pipeline,
    slicing,
    stability,
    supports,
    units,
)
from scripts.benchmarks.meshes import models_in  # noqa: E402
from scripts.benchmarks.tables import Table, write  # noqa: E402

SAMPLE: Final = ROOT / "assets" / "sample.glb"
OUT: Final = ROOT / "out" / "benchmark"


def main(arguments: Sequence[str]) -> int:
    """Run one benchmark and return the exit status."""
    options = parser().parse_args(arguments)
    try:
        tables = measured(options)
    except LegorizeError as error:
        print(error, file=sys.stderr)
        return 1
    write(options.out, options.command, tables)
    for table in tables:
        print(table.markdown())
    return 0


def measured(options: argparse.Namespace) -> list[Table]:
    """Return the tables of the chosen benchmark."""
    if options.command == "fuzz":
        return fuzz.measure(cases=options.cases, seed=options.seed, first=options.first)
    if options.command == "sliders":
        # its module brings Blender along, which the others do without
        from scripts.benchmarks import sliders

        return sliders.measure(bricks=options.bricks)
    paths = [*options.meshes, *(models_in(options.models) if options.models else ())] or [SAMPLE]
    if options.command == "slicing":
        return slicing.measure(
            paths,
            width=options.width,
            triangles=options.triangles,
            planes=options.planes,
            repeats=options.repeats,
        )
    if options.command == "units":
        return units.measure(
            paths, width=options.width, triangles=options.triangles, points=options.points, repeats=options.repeats
        )
    if options.command == "pipeline":
        return pipeline.measure(paths, widths=options.widths, repeats=options.repeats)
    if options.command == "budget":
        return budget.measure(paths, widths=options.widths)
    if options.command == "detail":
        return detail.measure(paths, widths=options.widths, judge=options.judge, out=options.out)
    if options.command == "stability":
        return stability.measure(paths, widths=options.widths, repeats=options.repeats, programme=options.programme)
    if options.command == "goals":
        return goals.measure(paths, widths=options.widths)
    if options.command == "layouts":
        chosen = {name: getattr(options, name) for name in ("width", "repeats", "seed", "peer", "peer_limit")}
        return layouts.measure(paths, **chosen)
    if options.command == "supports":
        return supports.measure(paths, width=options.width, repeats=options.repeats)
    if options.command == "building":
        return building.measure(paths, widths=options.widths, split=options.split)
    if options.command == "kills":
        return kills.measure(paths[0], runs=options.runs, moments=options.moments)
    if options.command == "hollowing":
        return hollowing.measure(paths, width=options.width)
    return judge.measure(paths, judge=options.judge, out=options.out, width=options.width, ldr_dir=options.ldr_dir)


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    made = argparse.ArgumentParser(description="Measure Legorize against references.")
    commands = made.add_subparsers(dest="command", required=True)
    for name, text, width, repeats in (
        ("slicing", "slices with loops, colours and areas", 48, 3),
        ("units", "unit bricks with their colours", 100, 3),
        ("pipeline", "every stage on every model", None, 1),
        ("budget", "estimates against what builds take", None, None),
        ("detail", "what plates gain and cost", None, None),
        ("hollowing", "what hollowing leaves", 64, None),
        ("stability", "whether models stand", None, 3),
        ("goals", "every goal of the layout", None, None),
        ("layouts", "the layouts of the field and ours", 48, 1),
        ("supports", "supports of every kind", 64, 3),
        ("building", "whether every model can be built", None, None),
        ("judge", "an external judge", 48, None),
        ("kills", "killed runs", None, None),
    ):
        command = commands.add_parser(name, help=text, description=text)
        command.add_argument("meshes", metavar="MESH", type=Path, nargs="*", help="model file")
        command.add_argument("--models", metavar="DIR", type=Path, help="folder with model files")
        command.add_argument("--out", metavar="DIR", type=Path, default=OUT, help="for results")
        if width is not None:
            command.add_argument("--width", type=int, default=width, help="studs (default: %(default)s)")
        if repeats is not None:
            command.add_argument("--repeats", type=int, default=repeats, help="runs (default: %(default)s)")
        add_options(name, command)
    command = commands.add_parser("fuzz", help="random cases", description="random bodies with random settings")
    command.add_argument("--cases", type=int, default=100, help="how many (default: %(default)s)")
    command.add_argument("--seed", type=int, default=0, help="of the cases (default: %(default)s)")
    command.add_argument("--first", type=int, default=0, help="number of the first case (default: %(default)s)")
    command.add_argument("--out", metavar="DIR", type=Path, default=OUT, help="for results")
    command = commands.add_parser("sliders", help="the sliders in Blender", description="the sliders in Blender")
    command.add_argument("--bricks", type=int, default=50_000, help="of the model (default: %(default)s)")
    command.add_argument("--out", metavar="DIR", type=Path, default=OUT, help="for results")
    return made


def add_options(name: str, command: argparse.ArgumentParser) -> None:
    """Add what only one of the benchmarks takes."""
    counts: dict[str, Any] = {"type": int, "nargs": "+"}
    text = "about how many triangles to subdivide to, 0 for none (default: %(default)s)"
    if name == "slicing":
        command.add_argument("--triangles", **counts, default=[0, 94_000, 1_500_000], help=text)
        command.add_argument("--planes", **counts, default=[50, 100, 200], help="(default: %(default)s)")
    elif name == "units":
        command.add_argument("--triangles", **counts, default=[0, 94_000], help=text)
        command.add_argument("--points", type=int, default=2_000_000, help="of the dense sampling")
    elif name in ("pipeline", "goals", "budget"):
        command.add_argument("--widths", **counts, default=[24, 48, 96], help="studs (default: %(default)s)")
    elif name == "stability":
        command.add_argument("--widths", **counts, default=[24, 48], help="studs (default: %(default)s)")
        command.add_argument("--programme", type=int, default=3000, help="bricks up to which HiGHS is timed")
    elif name == "building":
        command.add_argument("--widths", **counts, default=[64], help="studs (default: %(default)s)")
        command.add_argument("--split", type=int, default=3, help="most pieces (default: %(default)s)")
    elif name == "detail":
        command.add_argument("--widths", **counts, default=[32, 64], help="studs (default: %(default)s)")
        command.add_argument("--judge", metavar="DIR", type=Path, help="judge.py, which else is not asked")
    elif name == "layouts":
        command.add_argument("--seed", type=int, default=0, help="of everything random (default: %(default)s)")
        command.add_argument("--peer", metavar="PYTHON", type=Path, help="of an environment with legolization 0.5.0")
        command.add_argument(
            "--peer-limit",
            metavar="SECONDS",
            type=float,
            default=0.0,
            help="that the peer may take to make its layout hold; 0 only lets it lay (default: %(default)s)",
        )
    elif name == "kills":
        command.add_argument("--runs", type=int, default=200, help="whole runs to kill (default: %(default)s)")
        command.add_argument("--moments", type=int, default=100, help="kills within publishing (default: %(default)s)")
    elif name == "judge":
        command.add_argument("--judge", metavar="DIR", type=Path, required=True, help="judge.py and peer_voxels.py")
        command.add_argument("--ldr-dir", metavar="DIR", type=Path, help="NAME/model.ldr made by scripts/legorize.py")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
