"""Which changes of the core no test notices: constants that are moved, comparisons and signs that are turned round.

Each mutant is one change of one line. It is made in a copy of the repository,
where the tests of the changed module run alone, and then, if they let it pass,
those of all modules in its folder, and those of the whole package. What passes
all of them has survived.

References
----------
DeMillo, Lipton, Sayward: Hints on test data selection (IEEE Computer 11, 1978).
"""

from __future__ import annotations

import ast
import random
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from scripts.benchmarks.tables import Row, Table

ROOT: Final = Path(__file__).resolve().parents[2]
CORE: Final = Path("legorize_addon/core")
COPIED: Final = ("legorize_addon", "scripts", "tests", "assets", "pyproject.toml", "blender_manifest.toml")
LOGIC_PACKAGES: Final = ("statics", "building", "layout")
"""Where comparisons and signs are changed, too."""

LIMIT: Final = 300
"""Seconds for the tests of a mutant; an endless one is noticed."""

MOVED: Final = 1.5
"""Factor of a constant; whole numbers below ``SMALL`` become one more."""

SMALL: Final = 10

COMPARISONS: Final = {ast.Lt: "<=", ast.LtE: "<", ast.Gt: ">=", ast.GtE: ">", ast.Eq: "!=", ast.NotEq: "=="}
SIGNS: Final = {ast.Add: "-", ast.Sub: "+"}


@dataclass(frozen=True, slots=True)
class Mutant:
    """One change of one line.

    Attributes
    ----------
    path : Path
        Module, relative to the repository.
    kind : str
        ``"constant"`` or ``"logic"``.
    line : int
        From 1.
    start, end : int
        Columns that are replaced.
    new : str
        What stands there then.
    name : str
        Of the constant, or what stood there.
    """

    path: Path
    kind: str
    line: int
    start: int
    end: int
    new: str
    name: str

    def apply(self, text: str) -> str:
        """Return the text of the module with the change."""
        lines = text.split("\n")
        old = lines[self.line - 1].encode()
        lines[self.line - 1] = (old[: self.start] + self.new.encode() + old[self.end :]).decode()
        return "\n".join(lines)


def moved(path: Path) -> Iterator[Mutant]:
    """Yield a mutant for each number at the top of a module that has a name of its own."""
    for node in ast.parse((ROOT / path).read_text(encoding="utf-8")).body:
        target = node.target if isinstance(node, ast.AnnAssign) else node.targets[0] if _assigns(node) else None
        if not (isinstance(target, ast.Name) and target.id.strip("_").isupper()):
            continue
        for number in ast.walk(node.value):
            if _is_number(number):
                value = _move(number.value)
                place = (number.lineno, number.col_offset, number.end_col_offset)
                yield Mutant(path, "constant", *place, repr(value), target.id)


def _move(value: float) -> float:
    if isinstance(value, int):
        return value + 1 if value < SMALL else int(value * MOVED)
    return value * MOVED or 1.0


def _assigns(node: ast.stmt) -> bool:
    return isinstance(node, ast.Assign) and len(node.targets) == 1


def _is_number(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and type(node.value) in (int, float) and node.lineno == node.end_lineno


def turned(path: Path) -> Iterator[Mutant]:
    """Yield a mutant for each comparison of two values and each sum or difference on one line."""
    text = (ROOT / path).read_text(encoding="utf-8")
    lines = text.split("\n")
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Compare) and len(node.ops) == 1:
            left, right, kinds = node.left, node.comparators[0], COMPARISONS
            kind = type(node.ops[0])
        elif isinstance(node, ast.BinOp):
            left, right, kinds, kind = node.left, node.right, SIGNS, type(node.op)
        else:
            continue
        if kind in kinds and left.end_lineno == right.lineno:
            between = lines[left.end_lineno - 1].encode()[left.end_col_offset : right.col_offset]
            sign = between.strip(b" ()").decode()
            start = left.end_col_offset + between.index(sign.encode())
            yield Mutant(path, "logic", right.lineno, start, start + len(sign), kinds[kind], sign)


def measure(modules: Sequence[str], *, constants: int, logic: int, seed: int) -> list[Table]:
    """Try mutants.

    Parameters
    ----------
    modules : sequence of str
        Beginnings of the paths of modules below the core; all if there are none.
    constants, logic : int
        Mutants of each kind that are tried, chosen at random.
    seed : int
        Of that choice.

    Returns
    -------
    list of Table
        Each mutant that survived, and the shares.
    """
    paths = [path.relative_to(ROOT) for path in sorted((ROOT / CORE).rglob("*.py")) if path.name != "__init__.py"]
    paths = [path for path in paths if not modules or str(path.relative_to(CORE)).startswith(tuple(modules))]
    chosen = random.Random(seed)
    numbers = [mutant for path in paths for mutant in moved(path)]
    others = [each for path in paths if path.relative_to(CORE).parts[0] in LOGIC_PACKAGES for each in turned(path)]
    tried = [each for kind, most in ((numbers, constants), (others, logic)) for each in _some(kind, most, chosen)]
    with tempfile.TemporaryDirectory() as folder:
        for name in COPIED:
            (shutil.copytree if (ROOT / name).is_dir() else shutil.copy)(ROOT / name, Path(folder) / name)
        survived = _try(tried, Path(folder))
    rows: list[Row] = [
        {"module": str(each.path.relative_to(CORE)), "line": each.line, "name": each.name, "new": each.new}
        for each in survived
    ]
    return [
        Table("mutation_survived", "Changes that no test notices", tuple(rows or [{"module": "none"}])),
        Table("mutation", "Share of the changes that survive", tuple(_shares(tried, survived))),
    ]


def _some(mutants: Sequence[Mutant], most: int, chosen: random.Random) -> list[Mutant]:
    """Return mutants chosen at random, in random order: those tried until a run is stopped are a sample, too."""
    return [mutants[each] for each in chosen.sample(range(len(mutants)), min(most, len(mutants)))]


def _try(mutants: Sequence[Mutant], copy: Path) -> list[Mutant]:
    """Return the mutants that survive, and say each one's fate as it is known."""
    survived: list[Mutant] = []
    with Trial(copy) as trial:
        for number, mutant in enumerate(mutants, 1):
            lives = trial.survives(mutant)
            survived += [mutant] if lives else []
            said = "survives" if lives else "noticed"
            where = f"{mutant.path}:{mutant.line} {mutant.name}"
            print(f"{number}/{len(mutants)} {where} -> {mutant.new}: {said}", file=sys.stderr, flush=True)
    return survived


def _shares(tried: Sequence[Mutant], survived: Sequence[Mutant]) -> Iterator[Row]:
    for kind in ("constant", "logic"):
        all_of, left = (sum(each.kind == kind for each in those) for those in (tried, survived))
        yield {"kind": kind, "tried": all_of, "survived": left, "share": left / all_of if all_of else None}


class Trial:
    """Tests of a copy of the repository, run in forks of a process that has the libraries loaded.

    Parameters
    ----------
    copy : Path
        Folder of the copy.
    """

    def __init__(self, copy: Path) -> None:
        self.copy = copy
        command = [sys.executable, str(Path(__file__).with_name("forked_tests.py")), str(LIMIT)]
        self._server = subprocess.Popen(
            command, cwd=copy, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1
        )

    def __enter__(self) -> Trial:
        """Return this trial."""
        return self

    def __exit__(self, *_: object) -> None:
        """End the process."""
        self._server.communicate()

    def survives(self, mutant: Mutant) -> bool:
        """Return whether the tests of its module, folder and package let a mutant pass; the copy stays as it was."""
        text = (ROOT / mutant.path).read_text(encoding="utf-8")
        inside = mutant.path.relative_to(CORE)
        folder = sorted((self.copy / "tests/core" / inside.parent).glob("test_*.py"))
        own = [each for each in folder if each.name == f"test_{inside.name}"]
        package = self.copy / "tests/core" / inside.parts[0]
        rest = [each for each in sorted(package.rglob("test_*.py")) if each not in folder]
        (self.copy / mutant.path).write_text(mutant.apply(text), encoding="utf-8")
        try:
            near = [each for each in folder if each not in own]
            return self._pass(own) and self._pass(near) and self._pass(rest)
        finally:
            (self.copy / mutant.path).write_text(text, encoding="utf-8")

    def _pass(self, tests: Sequence[Path]) -> bool:
        server = self._server
        if not tests:
            return True
        if server.stdin is None or server.stdout is None:
            raise BrokenPipeError("the process that runs the tests has no pipes")
        print(*tests, sep="\t", file=server.stdin)
        return server.stdout.readline().strip() == "0"
