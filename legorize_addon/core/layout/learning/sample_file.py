"""The text of a file of samples: written, read from the disk within limits, and checked line by line.

A user may choose any file: a picture, a device without an end, a table that a spreadsheet has changed. Everything that
the training relies on is checked here, so that a wrong file gives one sentence that names the line.
"""

from __future__ import annotations

import math
import os
import re
import stat
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ...errors import SettingsError

MOST_SAMPLES: Final = 20_000
"""Samples in a file: learning adds 60 a model, and the time to train grows with their square."""

MOST_MODELS: Final = 10_000
"""Models in a file: their numbers are kept in 16 bits, and learning adds to them."""

MOST_BYTES: Final = 2_000_000
"""Size of a file: a line of a sample is at most 19 bytes long, and the facts above the table are short."""

SHIPPED_VERSION: Final = 1
"""Version of the files that are shipped."""

PARAMETERS: Final = ("C", "gamma")
LEAST: Final = 1e-6
GREATEST: Final = 1e6
"""Limits of the parameters: five powers of ten and two of the factors of the search for the best ones around it."""

_FACT: Final = "# "
_WHOLE: Final = re.compile(r"-?[0-9]{1,9}")


class SampleFileError(ValueError):
    """What is wrong with a file of samples, as the end of a sentence that begins with its name."""


def file_text(path: Path) -> str:
    """Read a text file of limited size.

    Parameters
    ----------
    path : Path

    Returns
    -------
    str

    Raises
    ------
    SampleFileError
        It is no ordinary file, too large, empty, or no text in UTF-8.
    OSError
        It cannot be opened or read.
    """
    if "\0" in str(path):
        raise SampleFileError("has a character in its name that file names cannot have")
    # opening a pipe would wait for a writer, so the kind of file is checked first
    _check_kind(path.stat())
    with path.open("rb") as file:
        _check_kind(os.fstat(file.fileno()))
        # a file may grow while it is read
        content = file.read(MOST_BYTES + 1)
    if len(content) > MOST_BYTES:
        raise SampleFileError(f"is larger than {MOST_BYTES // 1_000_000} MB")
    if not content.strip():
        raise SampleFileError("is empty")
    try:
        # some programs begin such a file with a byte order mark
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise SampleFileError("is not text in UTF-8") from error


def _check_kind(found: os.stat_result) -> None:
    if stat.S_ISDIR(found.st_mode):
        raise SampleFileError("is a folder")
    if not stat.S_ISREG(found.st_mode):
        raise SampleFileError("is a device or a pipe, not a file")
    # files that the system generates while they are read have no size
    if found.st_size == 0:
        raise SampleFileError("is empty")


def text_of(facts: Mapping[str, str], columns: Sequence[str], table: Iterable[Sequence[int]]) -> str:
    """Return the text of a file of samples: lines of ``# name: value``, then a table in CSV.

    Parameters
    ----------
    facts : mapping of str to str
    columns : sequence of str
        Of the table.
    table : iterable of sequence of int
        Its rows.

    Returns
    -------
    str
    """
    lines = [f"# {name}: {value}" for name, value in facts.items()]
    return "\n".join([*lines, ",".join(columns), *(",".join(map(str, row)) for row in table), ""])


def facts_and_rows(
    text: str, columns: Sequence[str], below: Sequence[int]
) -> tuple[Mapping[str, str], NDArray[np.int16]]:
    """Read the facts and the table of a file of samples.

    Parameters
    ----------
    text : str
        Lines of ``# name: value``, the names of the columns, then a row each line.
    columns : sequence of str
        Names of the columns, in their order.
    below : sequence of int
        Number that the values of each column, whole numbers from 0, stay below.

    Returns
    -------
    facts : mapping of str to str
    rows : (n, n_columns) int16 array

    Raises
    ------
    SampleFileError
        A line is neither, a fact stands there twice with different values, a
        value is out of range, or there are too many rows.
    """
    facts: dict[str, str] = {}
    rows: list[list[int]] = []
    for number, line in _lines(text):
        if line.startswith("#"):
            _note(facts, line, number)
            continue
        cells = [cell.strip() for cell in line.split(",")]
        if rows or cells != list(columns):
            rows.append(_row(cells, number, columns, below))
        if len(rows) > MOST_SAMPLES:
            raise SampleFileError(f"has more than {MOST_SAMPLES} samples")
    return facts, np.array(rows, dtype=np.int16).reshape(-1, len(columns))


def _lines(text: str) -> Iterator[tuple[int, str]]:
    """Yield the lines that are not empty, and their number from 1."""
    for number, line in enumerate(text.splitlines(), start=1):
        stripped = line.strip()
        if stripped:
            yield number, stripped


def _note(facts: dict[str, str], line: str, number: int) -> None:
    name, colon, value = line.removeprefix(_FACT).partition(":")
    if not colon or not line.startswith(_FACT):
        raise SampleFileError(f"has a line {number} that begins with # but is not '# name: value'")
    if facts.setdefault(name, value.strip()) != value.strip():
        raise SampleFileError(f"gives two different values for {_shown(name)}")


def _row(cells: Sequence[str], number: int, columns: Sequence[str], below: Sequence[int]) -> list[int]:
    if sorted(cells) == sorted(columns):
        raise SampleFileError(f"has its columns in line {number} in a wrong order, instead of {','.join(columns)}")
    if len(cells) != len(columns):
        held = f"{len(cells)} column{'s' * (len(cells) > 1)}"
        raise SampleFileError(f"has {held} in line {number}, where {','.join(columns)} are expected")
    for name, most, cell in zip(columns, below, cells, strict=True):
        if not _WHOLE.fullmatch(cell) or not 0 <= int(cell) < most:
            raise SampleFileError(
                f"has {_shown(cell)} for {name} in line {number}, where a whole number from 0 to {most - 1} is expected"
            )
    return [int(cell) for cell in cells]


def parameter(facts: Mapping[str, str], name: str) -> float:
    """Return a parameter of the machine from the facts of a file.

    Raises
    ------
    SampleFileError
        It is missing, no number, or out of range.
    """
    if name not in facts:
        raise SampleFileError(f"has no value for {name}")
    try:
        value = float(facts[name])
    except ValueError:
        value = math.nan
    # the negated form also refuses not-a-number
    if not LEAST <= value <= GREATEST:
        raise SampleFileError(
            f"has {_shown(facts[name])} for {name}, where a number from {LEAST:g} to {GREATEST:g} is needed"
        )
    return value


def whole(facts: Mapping[str, str], name: str, default: int) -> int:
    """Return a whole number from the facts of a file, or the default where it has none.

    Raises
    ------
    SampleFileError
        It is no whole number from 0.
    """
    value = facts.get(name, str(default))
    if not _WHOLE.fullmatch(value) or int(value) < 0:
        raise SampleFileError(f"has {_shown(value)} for {name}, where a whole number is expected")
    return int(value)


def check_both_kinds(columns: NDArray[np.int16], pays: NDArray[np.bool_]) -> None:
    """Refuse samples from which nothing can be learned.

    Parameters
    ----------
    columns : (n, k) int16 array
        What is known of each sample.
    pays : (n,) bool array
        Which of the two kinds it is.

    Raises
    ------
    SampleFileError
        There are no samples, only one kind of them, or every sample is
        contradicted by another one that is the same but of the other kind.
    """
    if len(pays) == 0:
        raise SampleFileError("has no samples")
    if pays.all() or not pays.any():
        raise SampleFileError(f"has {len(pays)} samples of one kind, but needs some that pay and some that do not")
    _, same = np.unique(columns, axis=0, return_inverse=True)
    if not np.bincount(same.reshape(-1), np.where(pays, 1, -1)).any():
        raise SampleFileError("has samples that contradict each other: of each kind as many pay as do not")


def _shown(value: str) -> str:
    """Return a value from a file, short and on one line."""
    most = 20
    return repr(value if len(value) <= most else value[: most - 3] + "...")


def checked_text(path: str, shipped: Path, facts_of: Callable[[str], Mapping[str, str]], advice: str) -> str:
    """Read a file of samples that a user chose, or the one that is shipped, and check its facts.

    Parameters
    ----------
    path : str
        The file; empty for the one that is shipped.
    shipped : pathlib.Path
        That one.
    facts_of : callable
        Reads a text to its end and returns its facts.
    advice : str
        What to do instead, the end of the sentence.

    Returns
    -------
    str
        Its text.

    Raises
    ------
    SettingsError
        It cannot be read, or is no such file.
    """
    try:
        text = file_text(Path(path or shipped))
        facts = facts_of(text)
        for name in PARAMETERS:
            parameter(facts, name)
        whole(facts, "version", SHIPPED_VERSION)
    except OSError as error:
        raise SettingsError(
            f"learned_from is {path!r}, which cannot be opened ({error.strerror or error}): {advice}"
        ) from error
    except SampleFileError as fault:
        raise SettingsError(f"learned_from is {path!r}, which {fault}: {advice}") from fault
    return text
