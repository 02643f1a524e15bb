"""Random bodies with random settings: none may end in a traceback, take too long or too much, or break a rule."""

from __future__ import annotations

import contextlib
import multiprocessing
import resource
import time
import traceback
from collections.abc import Callable
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Final

from legorize_addon.core.errors import LegorizeError
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.pipeline import legorize
from scripts.benchmarks.fuzz_bricks import document, outcome_of_bricks
from scripts.benchmarks.fuzz_cases import case
from scripts.benchmarks.fuzz_checks import cells_of, faults, n_components, n_lumps, same
from scripts.benchmarks.tables import Row, Table

Work = Callable[[int, int], tuple[str, str]]
"""Tells the outcome of a case, and what is to be said of it."""

MEMORY: Final = 2 << 30
"""Bytes of address space that a case may take, besides the programs it is made of."""

SECONDS: Final = 60
"""CPU time that a case may take."""

_TWICE: Final = 10
"""Every so many cases one is built twice."""

GOOD: Final = ("built", "refused", "several lumps")
"""Outcomes that are right."""


def measure(*, cases: int, seed: int, first: int = 0) -> list[Table]:
    """Build random cases, each in a process of its own.

    Parameters
    ----------
    cases : int
        How many.
    seed : int
    first : int
        Number of the first one.

    Returns
    -------
    list of Table
        A row for every outcome with its number, and one for every case that is
        not simply built.
    """
    return _tables([run(seed, number) for number in range(first, first + cases)], cases, seed)


def measure_bricks(*, cases: int, seed: int, first: int = 0) -> list[Table]:
    """Read, judge and lay again hostile brick models, each in a process of its own; as :func:`measure`."""
    rows: list[Row] = [
        {"case": number, "body": document(seed, number)[0], **limited(seed, number, outcome_of_bricks)}
        for number in range(first, first + cases)
    ]
    return _tables(rows, cases, seed)


def _tables(rows: list[Row], cases: int, seed: int) -> list[Table]:
    """Return how often each outcome came, and the rows of what is not simply built."""
    kinds = sorted({str(row["outcome"]) for row in rows})
    counts: tuple[Row, ...] = tuple(
        {"outcome": kind, "cases": sum(row["outcome"] == kind for row in rows), "met": kind in GOOD} for kind in kinds
    )
    told = tuple(row for row in rows if row["outcome"] != "built") or tuple(rows[:1])
    return [
        Table("outcomes", f"{cases} random cases with seed {seed}", counts),
        Table("cases", "Cases that are not simply built", told),
    ]


def run(seed: int, number: int, work: Work | None = None) -> Row:
    """Build a case in a process of its own, within limits.

    Parameters
    ----------
    seed, number : int
        Of the case.
    work : function of these two, optional
        What is done instead of :func:`outcome_of`.

    Returns
    -------
    dict
        Body, size, outcome, what is to be said, and CPU seconds.
    """
    name, _, settings = case(seed, number)
    size = f"{settings.size_by} {getattr(settings, settings.size_by)}"
    return {"case": number, "body": name, "size": size, **limited(seed, number, work or outcome_of)}


def limited(seed: int, number: int, work: Work) -> Row:
    """Work on a case in a process of its own, within limits; return outcome, what is to be said, and CPU seconds."""
    # the children of a server that has done nothing but import: what runs in this process does not touch them
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["__main__", __name__])
    here, there = context.Pipe(duplex=False)
    child = context.Process(target=_child, args=(there, seed, number, work, SECONDS))
    child.start()
    there.close()
    # a killed child says nothing, and its end of the pipe may live on in the server
    wait([here, child.sentinel])
    told: Row = {"outcome": "endless", "what": f"more than {SECONDS} s of CPU time, or killed"}
    with contextlib.suppress(EOFError):
        if here.poll():
            told = here.recv()
    child.join()
    return told


def _child(there: Connection, seed: int, number: int, work: Work, seconds: int) -> None:
    used = int(time.process_time())
    loaded = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (loaded + MEMORY, loaded + MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (used + seconds, used + seconds))
    start = time.process_time()

    def tell(outcome: str, what: str) -> None:
        there.send({"outcome": outcome, "what": " ".join(what.split()), "seconds": time.process_time() - start})

    try:
        tell(*work(seed, number))
    except MemoryError:
        tell("too large", f"more than {MEMORY >> 20} MB")
    except Exception as error:
        where = traceback.extract_tb(error.__traceback__)[-1]
        tell("traceback", f"{type(error).__name__}: {error} ({Path(where.filename).name}:{where.lineno})")
        # this process has nothing else to do but to show it
        raise


def outcome_of(seed: int, number: int) -> tuple[str, str]:
    """Build a case here; return what came of it, and what is to be said."""
    _, mesh, settings = case(seed, number)
    try:
        build = legorize(mesh, settings)
    except LegorizeError as error:
        return "refused", str(error)
    catalogue = load_catalogue()
    wrong = faults(build, catalogue)
    if number % _TWICE == 0 and not same(build, legorize(mesh, settings)):
        wrong.append("A second run gives another model.")
    if wrong:
        return "broken rule", " ".join(wrong)
    n = n_components(cells_of(build, catalogue))
    if n == 1:
        return "built", ""
    remark = next(note for note in build.notes if "in the air" in note or "pieces" in note)
    with_supports = settings.supports != "none" and settings.plates != "none"
    lumps = n_lumps(build)
    if lumps == 1 and with_supports:
        return "not joined", f"{n} components of one lump: {remark}"
    return ("several lumps" if lumps > 1 else "several"), f"{n} components of {lumps} lumps: {remark}"
