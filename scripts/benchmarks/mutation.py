"""Which changes of the core no test notices: constants that are moved, comparisons and signs that are turned round.

Each mutant is one change of one line. It is made in a copy of the repository,
where the tests of the changed module run alone, and then, if they let it pass,
those of all modules in its folder. What passes both has survived.

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
"""Factor of a constant that is no whole number; whole ones become one more."""

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


def constants(path: Path) -> Iterator[Mutant]:
    """Yield a mutant for each number at the top of a module that has a name of its own."""
    for node in ast.parse((ROOT / path).read_text(encoding="utf-8")).body:
        target = node.target if isinstance(node, ast.AnnAssign) else node.targets[0] if _assigns(node) else None
        if not (isinstance(target, ast.Name) and target.id.strip("_").isupper()):
            continue
        for number in ast.walk(node.value):
            if _is_number(number):
                value = number.value * MOVED if isinstance(number.value, float) and number.value else number.value + 1
                place = (number.lineno, number.col_offset, number.end_col_offset)
                yield Mutant(path, "constant", *place, repr(value), target.id)


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


def measure(modules: Sequence[str], *, logic: int, seed: int) -> list[Table]:
    """Try mutants.

    Parameters
    ----------
    modules : sequence of str
        Beginnings of the paths of modules below the core; all if there are none.
    logic : int
        Mutants of logic that are tried, chosen at random.
    seed : int
        Of that choice.

    Returns
    -------
    list of Table
        Each mutant that survived, and the shares.
    """
    paths = [path.relative_to(ROOT) for path in sorted((ROOT / CORE).rglob("*.py")) if path.name != "__init__.py"]
    paths = [path for path in paths if not modules or str(path.relative_to(CORE)).startswith(tuple(modules))]
    tried = [mutant for path in paths for mutant in constants(path)]
    others = [each for path in paths if path.relative_to(CORE).parts[0] in LOGIC_PACKAGES for each in turned(path)]
    tried += random.Random(seed).sample(others, min(logic, len(others)))
    survived: list[Mutant] = []
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder)
        for name in COPIED:
            (shutil.copytree if (ROOT / name).is_dir() else shutil.copy)(ROOT / name, copy / name)
        for number, mutant in enumerate(tried):
            lives = survives(mutant, copy)
            survived += [mutant] if lives else []
            said = "survives" if lives else "noticed"
            where = f"{mutant.path}:{mutant.line} {mutant.name}"
            print(f"{number + 1}/{len(tried)} {where} -> {mutant.new}: {said}", file=sys.stderr, flush=True)
    rows: list[Row] = [
        {"module": str(each.path.relative_to(CORE)), "line": each.line, "name": each.name, "new": each.new}
        for each in survived
    ]
    return [
        Table("mutation_survived", "Changes that no test notices", tuple(rows or [{"module": "none"}])),
        Table("mutation", "Share of the changes that survive", tuple(_shares(tried, survived))),
    ]


def _shares(tried: Sequence[Mutant], survived: Sequence[Mutant]) -> Iterator[Row]:
    for kind in ("constant", "logic"):
        all_of, left = (sum(each.kind == kind for each in those) for those in (tried, survived))
        yield {"kind": kind, "tried": all_of, "survived": left, "share": left / all_of if all_of else None}


def survives(mutant: Mutant, copy: Path) -> bool:
    """Return whether the tests of its module and of its folder let a mutant in a copy of the repository pass."""
    text = (ROOT / mutant.path).read_text(encoding="utf-8")
    inside = mutant.path.relative_to(CORE)
    tests = Path("tests/core") / inside.parent
    own = tests / f"test_{inside.name}"
    (copy / mutant.path).write_text(mutant.apply(text), encoding="utf-8")
    try:
        return all(_passes(copy, each) for each in (own, tests) if (copy / each).exists())
    finally:
        (copy / mutant.path).write_text(text, encoding="utf-8")


def _passes(copy: Path, tests: Path) -> bool:
    """Run tests in a copy of the repository until one fails."""
    kept = ("-p", "no:cacheprovider", "-p", "no:randomly")
    command = [sys.executable, "-m", "pytest", "-x", "-q", *kept, "-m", "not slow and not gui", str(tests)]
    try:
        done = subprocess.run(command, cwd=copy, capture_output=True, timeout=LIMIT, check=False)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0
