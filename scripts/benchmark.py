"""Measure Legorize against references, in the same run on the same machine.

::

    python scripts/benchmark.py slicing   [MESH ...] [--out DIR]   against trimesh and shapely
    python scripts/benchmark.py units     [MESH ...] [--out DIR]   against trimesh, the exact rule, dense sampling
    python scripts/benchmark.py pipeline  [MESH ...] [--out DIR]   every stage, every result
    python scripts/benchmark.py updates   [MESH ...] [--out DIR]   a setting changed after a run, and live previews
    python scripts/benchmark.py budget    [MESH ...] [--out DIR]   estimates against what builds take
    python scripts/benchmark.py prices    [MESH ...] [--out DIR]   cheapest models against the fewest bricks
    python scripts/benchmark.py owned     [MESH ...] [--out DIR]   models of classic boxes, nothing overdrawn
    python scripts/benchmark.py sizes     [MESH ...] [--out DIR]   as large as numbers of parts allow
    python scripts/benchmark.py lots      [MESH ...] [--out DIR]   fewer lots: likeness and bricks
    python scripts/benchmark.py masses    [MESH ...] [--out DIR]   grams against bricks
    python scripts/benchmark.py detail    [MESH ...] [--judge DIR] what plates gain and cost
    python scripts/benchmark.py published [MESH ...] [--out DIR]   as in the paper, beside the default
    python scripts/benchmark.py hollowing [MESH ...] [--out DIR]   against a shell of two cells
    python scripts/benchmark.py stability [MESH ...] [--out DIR]   against HiGHS, and the StableLego cases
    python scripts/benchmark.py goals     [MESH ...] [--out DIR]   every goal of the layout, in one table
    python scripts/benchmark.py layouts   [MESH ...] [--peer PY]   against the layouts of the field, and a peer
    python scripts/benchmark.py tables    [MESH ...] [--out DIR]   the paper's Tables 1 to 4 and claims H1 to H13
    python scripts/benchmark.py supports  [MESH ...] [--out DIR]   trees, columns and beams against full columns
    python scripts/benchmark.py building  [MESH ...] [--out DIR]   building orders, followed from their files
    python scripts/benchmark.py steps     [MESH ...] [--minutes N] whether hands can follow the building steps
    python scripts/benchmark.py judge     [MESH ...] --judge DIR   an external judge, on our bricks and on a peer's
    python scripts/benchmark.py mosaics   [IMAGE ...] [--out DIR]  likeness from afar, against a plain mosaic
    python scripts/benchmark.py kills    [MESH] [--runs N] [--out DIR] killed runs: old or new results, nothing left
    python scripts/benchmark.py fuzz     [--cases N] [--seed S]    random bodies with random settings, within limits
    python scripts/benchmark.py fuzz-bricks [--cases N] [--seed S] hostile brick models, read, judged and laid again
    python scripts/benchmark.py sliders  [--bricks N] [--out DIR] what Blender takes to show layers and sections
    python scripts/benchmark.py mutation [MODULE ...] [--seed S]   changes of the core that no test notices

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
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
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
    mosaics,
    mutation,
    pipeline,
    published,
    purchase,
    sizes,
    slicing,
    stability,
    steps,
    supports,
    units,
    updates,
)
from scripts.benchmarks.meshes import models_in  # noqa: E402
from scripts.benchmarks.tables import Table, write  # noqa: E402
from scripts.research import layouts, paper_tables  # noqa: E402

SAMPLE: Final = ROOT / "assets" / "sample.glb"
OUT: Final = ROOT / "out" / "benchmark"

Option = tuple[str, dict[str, Any]]
"""A flag and what argparse is told of it."""


def number(flag: str, default: float, text: str, **more: Any) -> Option:
    """Return a flag with one number."""
    return flag, {"type": type(default), "default": default, "help": f"{text} (default: %(default)s)"} | more


def numbers(flag: str, default: Sequence[int], text: str) -> Option:
    """Return a flag with several whole numbers."""
    return flag, {"type": int, "nargs": "+", "default": list(default), "help": f"{text} (default: %(default)s)"}


def folder(flag: str, text: str, **more: Any) -> Option:
    """Return a flag with a path."""
    return flag, {"type": Path, "metavar": "PATH", "help": text} | more


MESHES: Final = (
    ("meshes", {"metavar": "MESH", "type": Path, "nargs": "*", "help": "model file"}),
    folder("--models", "folder with model files"),
)
TRIANGLES: Final = "about how many triangles to subdivide to, 0 for none"
RUNS: Final = number("--repeats", 3, "runs")
MINUTES: Final = number("--minutes", 0.0, "after which no build is begun; the next run goes on; 0 for no limit")
SEED: Final = number("--seed", 0, "of everything random")


def on_models(measure: Callable[..., list[Table]]) -> Callable[..., list[Table]]:
    """Return a measurement of the models that the command line names, else of the sample."""

    def measured(meshes: Sequence[Path], models: Path | None, **options: Any) -> list[Table]:
        return measure([*meshes, *(models_in(models) if models else ())] or [SAMPLE], **options)

    return measured


def kill(paths: Sequence[Path], **options: Any) -> list[Table]:
    """Kill runs on the first model."""
    return kills.measure(paths[0], **options)


def slide(**options: Any) -> list[Table]:
    """Move the sliders; only this module brings Blender along."""
    from scripts.benchmarks import sliders

    return sliders.measure(**options)


@dataclass(frozen=True)
class Benchmark:
    """A command.

    Attributes
    ----------
    text : str
        What it measures.
    measure : callable
        Takes its options by name; those that it names in `needs_out` get the folder for results, too.
    options : tuple of Option
    """

    text: str
    measure: Callable[..., list[Table]]
    options: tuple[Option, ...] = ()
    needs_out: bool = False


def of_models(text: str, measure: Callable[..., list[Table]], *options: Option, needs_out: bool = False) -> Benchmark:
    """Return a command that measures models."""
    return Benchmark(text, on_models(measure), (*MESHES, *options), needs_out)


BENCHMARKS: Final[Mapping[str, Benchmark]] = MappingProxyType(
    {
        "slicing": of_models(
            "slices with loops, colours and areas", slicing.measure, number("--width", 48, "studs"), RUNS,
            numbers("--triangles", [0, 94_000, 1_500_000], TRIANGLES), numbers("--planes", [50, 100, 200], "heights"),
        ),
        "units": of_models(
            "unit bricks with their colours", units.measure, number("--width", 100, "studs"), RUNS,
            numbers("--triangles", [0, 94_000], TRIANGLES), number("--points", 2_000_000, "of the dense sampling"),
        ),
        "pipeline": of_models(
            "every stage on every model", pipeline.measure, numbers("--widths", [24, 48, 96], "studs"),
            number("--repeats", 1, "runs"),
        ),
        "updates": of_models(
            "a setting changed after a run, and live previews", updates.measure, number("--width", 64, "studs"), RUNS
        ),
        "budget": of_models(
            "estimates against what builds take", budget.measure, numbers("--widths", [24, 48, 96], "studs")
        ),
        "prices": of_models(
            "cheapest models against the fewest bricks", purchase.measure_prices, numbers("--widths", [32], "studs")
        ),
        "owned": of_models(
            "models of classic boxes", purchase.measure_owned, numbers("--widths", [24, 32], "studs"),
            numbers("--times", [1, 3, 10], "boxes"),
        ),
        "sizes": of_models(
            "as large as numbers of parts allow", sizes.measure, numbers("--parts", [300, 1000, 3000], "parts"),
            ("--budgets", {"type": float, "nargs": "*", "default": [], "help": "amounts of money"}),
        ),
        "lots": of_models(
            "fewer lots of parts", purchase.measure_lots, number("--width", 32, "studs"),
            ("--limits", {"type": float, "nargs": "+", "default": [0.0, 5.0, 10.0, 20.0],
                          "help": "largest colour differences"}),
        ),
        "masses": of_models(
            "grams against bricks", purchase.measure_masses, numbers("--widths", [24, 48], "studs"),
            ("--weights", {"type": float, "nargs": "+", "default": [0.0, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0],
                           "help": "bricks for a gram"}),
        ),
        "detail": of_models(
            "what plates gain and cost", detail.measure, numbers("--widths", [32, 64], "studs"),
            folder("--judge", "folder with judge.py, which else is not asked"), needs_out=True,
        ),
        "published": of_models(
            "models as in the paper beside the default", published.measure, numbers("--widths", [32, 48], "studs"),
            MINUTES, needs_out=True,
        ),
        "hollowing": of_models("what hollowing leaves", hollowing.measure, number("--width", 64, "studs")),
        "stability": of_models(
            "whether models stand", stability.measure, numbers("--widths", [24, 48], "studs"), RUNS,
            number("--programme", 3000, "bricks up to which HiGHS is timed"),
        ),
        "goals": of_models("every goal of the layout", goals.measure, numbers("--widths", [24, 48, 96], "studs")),
        "layouts": of_models(
            "the layouts of the field and ours", layouts.measure, number("--width", 48, "studs"),
            number("--repeats", 1, "runs"), SEED,
            folder("--peer", "Python of an environment with legolization 0.5.0"),
            number("--peer-limit", 0.0, "seconds that the peer may take to make its layout hold; 0 only lets it lay"),
        ),
        "tables": of_models(
            "the paper's Tables 1 to 4 and claims H1 to H13", paper_tables.measure,
            number("--width", 32, "studs"), SEED, number("--repeats", 1, "runs"), MINUTES, needs_out=True,
        ),
        "supports": of_models("supports of every kind", supports.measure, number("--width", 64, "studs"), RUNS),
        "building": of_models(
            "whether every model can be built", building.measure, numbers("--widths", [64], "studs"),
            number("--split", 3, "most pieces"),
        ),
        "steps": of_models(
            "whether hands can follow the building steps", steps.measure, numbers("--widths", [32, 48], "studs"),
            number("--split", 8, "most pieces"),
            MINUTES,
            needs_out=True,
        ),
        "judge": of_models(
            "an external judge", judge.measure, number("--width", 48, "studs"),
            folder("--judge", "folder with judge.py and peer_voxels.py", required=True),
            folder("--ldr-dir", "folder with NAME/model.ldr made by scripts/legorize.py"), needs_out=True,
        ),
        "mosaics": Benchmark(
            "mosaics of a photograph and a logo", mosaics.measure,
            (
                ("images", {"metavar": "IMAGE", "type": Path, "nargs": "*", "help": "image file"}),
                numbers("--widths", [48, 96], "studs"),
                ("--kind", {"choices": ("tiles", "plates", "bricks"), "default": "tiles", "help": "of the parts"}),
            ),
        ),
        "kills": of_models(
            "killed runs", kill, number("--runs", 200, "whole runs to kill"),
            number("--moments", 100, "kills within publishing"),
        ),
        "fuzz": Benchmark(
            "random bodies with random settings", fuzz.measure,
            (number("--cases", 100, "how many"), SEED, number("--first", 0, "number of the first case")),
        ),
        "fuzz-bricks": Benchmark(
            "hostile brick models, read, judged and laid again", fuzz.measure_bricks,
            (number("--cases", 100, "how many"), SEED, number("--first", 0, "number of the first case")),
        ),
        "sliders": Benchmark("the sliders in Blender", slide, (number("--bricks", 50_000, "of the model"),)),
        "mutation": Benchmark(
            "changes of the core that no test notices", mutation.measure,
            (
                ("modules", {"metavar": "MODULE", "nargs": "*", "help": "beginning of a path below the core"}),
                number("--constants", 200, "constants to move, at most"),
                number("--logic", 100, "comparisons and signs to turn, at most"), SEED,
            ),
        ),
    }
)  # fmt: skip
"""Every command."""


def main(arguments: Sequence[str]) -> int:
    """Run one benchmark and return the exit status."""
    options = vars(parser().parse_args(arguments))
    command, out = options.pop("command"), options.pop("out")
    benchmark = BENCHMARKS[command]
    try:
        tables = benchmark.measure(**options, **({"out": out} if benchmark.needs_out else {}))
    except LegorizeError as error:
        print(error, file=sys.stderr)
        return 1
    write(out, command, tables)
    for table in tables:
        print(table.markdown())
    return 0


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    made = argparse.ArgumentParser(description="Measure Legorize against references.")
    commands = made.add_subparsers(dest="command", required=True)
    for name, benchmark in BENCHMARKS.items():
        command = commands.add_parser(name, help=benchmark.text, description=benchmark.text)
        command.add_argument("--out", metavar="DIR", type=Path, default=OUT, help="for results")
        for flag, told in benchmark.options:
            command.add_argument(flag, **told)
    return made


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
