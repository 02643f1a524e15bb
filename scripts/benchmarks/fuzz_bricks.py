"""Hostile brick models: documents that are damaged, endless, huge or strange, read, judged and laid again."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

import numpy as np

from legorize_addon.core.errors import LegorizeError
from legorize_addon.core.existing import Existing
from legorize_addon.core.ldraw.reader import LdrawModel, read_file
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.pipeline import judge
from legorize_addon.core.settings import Settings

Files = dict[str, bytes]
"""Contents by name."""

MAIN: Final = "model.mpd"
LONGEST: Final = 600
"""Letters of a sentence that people still read."""

_UPRIGHT: Final = "1 0 0 0 1 0 0 0 1"
_LONG_LINE: Final = 10_000_000
_MATRICES: Final = (
    _UPRIGHT,
    "0 0 1 0 1 0 -1 0 0",
    "-1 0 0 0 1 0 0 0 1",
    "1 0 0 0 1 0 0 0 -1",
    "1 0 0 0 -1 0 0 0 1",
    "0 0 0 0 0 0 0 0 0",
    "1 0.5 0 0 1 0 0 0 1",
    "2 0 0 0 1 0 0 0 1",
    "1e6 0 0 0 1e6 0 0 0 1e6",
    "0.999 0.001 0 0 1 0 0 0 1",
)
"""Turns, mirrors, nothing at all, shears, stretches, rounding."""

_NUMBERS: Final = ("nan", "-nan", "inf", "-inf", "1e300", "-1e99", "9999999", "1e-300", "0x10", "", "1,5", "--1")
_COLOURS: Final = ("4", "16", "24", "99999", "0x2FF8800", "0x3112233", "#2FFFFFF", "-1", "0x", "red", "1" * 5000)
_PARTS: Final = (
    "3001.dat",
    "3005.DAT",
    "s\\3001s01.dat",
    "54200.dat",
    "3040b.dat",
    "gone.ldr",
    "../up.ldr",
    "stud.dat",
)
_NOISE: Final = (
    b"\xff",
    b"\x80\x81",
    b"\xed\xa0\x80",
    b"\x1b[31m",
    b"\r",
    b"\x85",
    "\u2028".encode(),
    b"\t\t",
    b"\x0c",
)


def document(seed: int, number: int) -> tuple[str, Files]:
    """Make up a document: the same two numbers give the same one; return what is strange about it, and its files."""
    rng = np.random.default_rng([seed, number])
    name = str(rng.choice(sorted(STRANGE)))
    return name, STRANGE[name](rng)


def outcome_of_bricks(seed: int, number: int) -> tuple[str, str]:
    """Read, judge and lay again a document here; return what came of it, and what is to be said."""
    name, files = document(seed, number)
    with TemporaryDirectory() as folder:
        for each, data in files.items():
            (Path(folder) / each).write_bytes(data)
        try:
            found = read_file(Path(folder) / MAIN, load_catalogue())
            wrong = _faults(found)
            made = judge(Existing.of(found), Settings(layout="fast"), again=number % 2 == 0)
            wrong += [note for note in made.notes if not _is_sentence(note)]
        except LegorizeError as error:
            return ("refused" if _is_sentence(str(error)) else "broken rule"), f"{name}: {str(error)[:LONGEST]}"
        left = {each for each in Path(folder).iterdir() if each.name not in files}
        if left or any((Path(folder) / each).read_bytes() != data for each, data in files.items()):
            wrong.append("The files are not as they were.")
    return ("broken rule" if wrong else "built"), f"{name}: {' '.join(wrong)[:LONGEST]}"


def _faults(found: LdrawModel) -> list[str]:
    """Return what is wrong with a model that was read."""
    wrong = [remark for remark in found.remarks if not _is_sentence(remark)]
    if len(found.line) != len(found.bricks):
        wrong.append("Lines and bricks differ in number.")
    return wrong


def _is_sentence(text: str) -> bool:
    """Tell whether a text can be shown: one line, not endless, and with an end."""
    return text.endswith(".") and text.isprintable() and len(text) <= LONGEST


def _wall(rng: np.random.Generator) -> list[str]:
    """Return the lines of a small wall."""
    long, high = (int(rng.integers(1, 5)) for _ in range(2))
    return [
        f"1 4 {40 + 80 * x + 20 * (z % 2)} {-24 * z - 24} 10 {_UPRIGHT} 3010.dat"
        for z in range(high)
        for x in range(long)
    ]


def _text(*lines: str) -> Files:
    return {MAIN: "\r\n".join(lines).encode()}


def _call(name: str, rng: np.random.Generator) -> str:
    return f"1 16 0 {int(rng.integers(-9, 1)) * 24} 0 {_UPRIGHT} {name}"


def _words(rng: np.random.Generator) -> Files:
    """Return a wall with lines of strange numbers, colours, matrices and parts."""
    lines = _wall(rng)
    for _ in range(int(rng.integers(1, 9))):
        place = [str(rng.choice([*_NUMBERS, "20", "-24", "10"])) for _ in range(3)]
        line = f"1 {rng.choice(_COLOURS)} {' '.join(place)} {rng.choice(_MATRICES)} {rng.choice(_PARTS)}"
        lines.insert(int(rng.integers(len(lines) + 1)), line)
    return _text(*lines)


def _directly_coloured(rng: np.random.Generator) -> Files:
    """Return a wall in values instead of codes."""
    return _text(*(line.replace("1 4", f"1 0x2{int(rng.integers(1 << 24)):06X}", 1) for line in _wall(rng)))


def _mirrored(rng: np.random.Generator) -> Files:
    """Return a wall in one of the matrices, called in another one."""
    inner = (line.replace(_UPRIGHT, str(rng.choice(_MATRICES))) for line in _wall(rng))
    return _text("0 FILE a", f"1 16 0 0 0 {rng.choice(_MATRICES)} b", "0 FILE b", *inner)


def _in_itself(rng: np.random.Generator) -> Files:
    """Return models that contain each other."""
    n = int(rng.integers(1, 5))
    return _text(
        *(line for row in range(n) for line in (f"0 FILE m{row}", *_wall(rng), _call(f"m{(row + 1) % n}", rng)))
    )


def _files_in_each_other(rng: np.random.Generator) -> Files:
    """Return files that call each other, or more and more others, one of which is no text."""
    n = int(rng.integers(1, 260))
    files = {f"m{row}.ldr": f"{_call(f'm{row + 1}.ldr', rng)}\n".encode() for row in range(n)}
    end = [_call(MAIN, rng).encode(), _call("m0.ldr", rng).encode(), b"\0\x01", b"", "\n".join(_wall(rng)).encode()]
    return {
        **files,
        f"m{n}.ldr": end[int(rng.integers(len(end)))],
        MAIN: "\n".join([*_wall(rng), _call("m0.ldr", rng)]).encode(),
    }


def _unfolding(rng: np.random.Generator) -> Files:
    """Return models that call the next one several times: of parts, of steps, or of nothing."""
    deep, wide = int(rng.integers(2, 80)), int(rng.integers(1, 12))
    inner = [["0 STEP"], _wall(rng), []][int(rng.integers(3))]
    lines = [
        line for row in range(deep) for line in (f"0 FILE m{row}", *(_call(f"m{row + 1}", rng) for _ in range(wide)))
    ]
    return _text(*lines, *_wall(rng), f"0 FILE m{deep}", *inner)


def _nested(rng: np.random.Generator) -> Files:
    """Return a long chain of models, each far away in the one that calls it, or larger."""
    deep, far = int(rng.integers(2, 6000)), str(rng.choice(["0", "20", "9999980", "-9999980"]))
    matrix = str(rng.choice(_MATRICES))
    lines = [f"0 FILE m{row}\r\n1 16 {far} 0 0 {matrix} m{row + 1}" for row in range(deep)]
    return _text(*lines, f"0 FILE m{deep}", *_wall(rng))


def _long_line(rng: np.random.Generator) -> Files:
    """Return a wall with a line that has no end: a name, a number, a comment, or words."""
    long = _LONG_LINE
    line = [
        f"1 4 0 0 0 {_UPRIGHT} {'a' * long}.dat", f"1 4 {'9' * long} 0 0 {_UPRIGHT} 3001.dat", "0 " + "x" * long,
        "1 " * (long // 2), "a" * long, f"1 {'7' * long} 0 0 0 {_UPRIGHT} 3001.dat", f"0 FILE {'m' * long}",
    ][int(rng.integers(7))]  # fmt: skip
    return _text(*_wall(rng), line, *_wall(rng))


def _damaged(rng: np.random.Generator) -> Files:
    """Return a wall with bytes that are no text, are controls, or are missing."""
    data = bytearray("\n".join(_wall(rng)).encode(str(rng.choice(["utf-8", "utf-16", "utf-16-le", "utf-32"]))))
    for _ in range(int(rng.integers(1, 6))):
        at = int(rng.integers(len(data) + 1))
        data[at : at + int(rng.integers(3))] = _NOISE[int(rng.integers(len(_NOISE)))]
    return {MAIN: bytes(data)}


def _unnamed(rng: np.random.Generator) -> Files:
    """Return parts whose names would do harm in a terminal, a table or a path."""
    names = [
        "\x1b]0;title\x07.dat",
        "=cmd|' /C calc'!A0",
        "..\\..\\etc\\passwd",
        "\u202egnp.dat",
        " ",
        "con",
        "a" * 900,
    ]
    lines = [f"1 4 0 0 0 {_UPRIGHT} {rng.choice(names)}" for _ in range(int(rng.integers(1, 20)))]
    return _text(*_wall(rng), *lines)


def _many_unknown(rng: np.random.Generator) -> Files:
    """Return a wall among parts that no catalogue has, thousands of kinds."""
    lines = [f"1 4 0 0 0 {_UPRIGHT} x{int(rng.integers(1 << 30))}.dat" for _ in range(int(rng.integers(1, 5000)))]
    return _text(*_wall(rng), *lines)


def _far(rng: np.random.Generator) -> Files:
    """Return walls far from each other, or one within the other."""
    away = int(rng.choice([0, 20, 20_000, 9_000_000]))
    return _text(*_wall(rng), f"1 14 {away} -24 {away} {_UPRIGHT} 3001.dat", *_wall(rng))


STRANGE: Final[dict[str, Callable[[np.random.Generator], Files]]] = {
    made.__name__.lstrip("_"): made
    for made in (
        *(_words, _directly_coloured, _mirrored, _in_itself, _files_in_each_other, _unfolding, _nested, _long_line),
        *(_damaged, _unnamed, _many_unknown, _far),
    )
}  # fmt: skip
