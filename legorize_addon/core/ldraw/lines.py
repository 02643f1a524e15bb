"""The lines of an LDraw document, model by model.

References
----------
LDraw.org, "LDraw File Format Specification", "MPD Extension" and "Colour Definition Language".
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Final

from ..errors import BuildError
from ..model import Role
from ..safe_text import one_line

FARTHEST: Final = 1e7
"""LDU from the origin beyond which no line is believed: four kilometres."""

MOST_BYTES: Final = 64_000_000
"""Of a file: a brick takes about 40 of them, so this is more than a million bricks."""

NAMED: Final = 40
"""Letters of a name in a sentence."""

DIRECT: Final = (0x2000000, 0x3000000)
"""Solid and transparent direct colours: the sum of one of these and 0xRRGGBB."""


@dataclass(frozen=True, slots=True)
class Reference:
    """A line that puts a part or another model into a model.

    Attributes
    ----------
    line : int
        Number in its document, from 1.
    colour : int
        Code, or a direct colour.
    numbers : tuple of 12 float
        Place, then matrix row by row, as in the line.
    name : str
        What it puts there, in lower case.
    role, piece : int
        Of a brick of our own files; ``SHELL`` and 0 without their comment.
    """

    line: int
    colour: int
    numbers: tuple[float, ...]
    name: str
    role: int
    piece: int


@dataclass(frozen=True, slots=True)
class Section:
    """One model of a document, filled as its lines are read.

    Attributes
    ----------
    items : list of Reference or None
        In the order of the file; None ends a step.
    drawn : list of int
        Numbers of lines that draw geometry of their own.
    turned : list of int
        Items up to an end of a step that turns the view, as long as no plain one came.
    """

    items: list[Reference | None] = field(default_factory=list)
    drawn: list[int] = field(default_factory=list)
    turned: list[int] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Document:
    """All models of a file, filled as its lines are read.

    Attributes
    ----------
    sections : dict of str to Section
        By name in lower case, in the order of the file.
    colours : dict of int to (int, int, int)
        Codes that the file itself defines.
    broken : list of int
        Numbers of lines that are not LDraw.
    """

    sections: dict[str, Section] = field(default_factory=dict)
    colours: dict[int, tuple[int, int, int]] = field(default_factory=dict)
    broken: list[int] = field(default_factory=list)

    @property
    def main(self) -> str:
        """Name of the first model, which is the one that is read."""
        return next(iter(self.sections))


def brief(name: str) -> str:
    """Return a name that can stand in a sentence: in one line, without controls, and not endless."""
    name = one_line(name[: 2 * NAMED])
    return name if len(name) <= NAMED else f"{name[: NAMED - 1]}\u2026"


def decoded(data: bytes, name: str) -> str:
    """Return the text of a file.

    Raises
    ------
    BuildError
        It is too long, or no text.
    """
    if len(data) > MOST_BYTES:
        raise BuildError(
            f"{name} has {len(data) / 1e6:.0f} MB, more than the {MOST_BYTES / 1e6:.0f} MB that are read: split it."
        )
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", "replace")
    if b"\0" in data:
        raise BuildError(f"{name} is not an LDraw file, because it is not text: export the model as .ldr or .mpd.")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        # of Windows programs before UTF-8 became the rule; only titles and names have such letters
        return data.decode("cp1252", "replace")


def parse(text: str) -> Document:
    """Return the models of a document.

    Lines that are not LDraw are noted, not refused. What precedes the first
    ``0 FILE`` is a model of its own if it has parts.
    """
    document, name = Document(), ""
    document.sections[""] = section = Section()
    listening = True
    kind = (int(Role.SHELL), 0)
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.split()
        if not words:
            continue
        if words[:2] in (["0", "FILE"], ["0", "NOFILE"]):
            listening, name = words[1] == "FILE", " ".join(words[2:]).lower()
            if listening:
                # of two models of one name the first one counts
                section, kind = Section(), (int(Role.SHELL), 0)
                document.sections.setdefault(name, section)
        elif listening:
            kind = _take(document, section, kind, number, words)
    if not section_has_parts(document.sections[""]) and len(document.sections) > 1:
        del document.sections[""]
    return document


def section_has_parts(section: Section) -> bool:
    """Tell whether a model puts anything anywhere."""
    return any(item is not None for item in section.items)


def _take(
    document: Document, section: Section, kind: tuple[int, int], number: int, words: list[str]
) -> tuple[int, int]:
    """Take a line into a model; return role and piece of the bricks after it."""
    if words[0] == "1":
        item = _reference(number, words, kind)
        if item is None:
            document.broken.append(number)
        else:
            section.items.append(item)
    elif words[0] in ("2", "3", "4", "5"):
        section.drawn.append(number)
    elif words[0] != "0":
        document.broken.append(number)
    elif words[1:2] == ["ROTSTEP"]:
        section.items.append(None)
        section.turned.append(len(section.items))
    elif words[1:2] == ["STEP"]:
        # for programs that do not know the one before, a plain end says the same again
        if section.turned[-1:] != [len(section.items)]:
            section.items.append(None)
        section.turned.clear()
    elif words[1:2] == ["!COLOUR"]:
        document.colours.update(_definition(words))
    elif words[1:3] == ["!LEGORIZE", "ROLE"]:
        found = _kind(words)
        if found is None:
            document.broken.append(number)
        return found or kind
    return kind


def _reference(number: int, words: list[str], kind: tuple[int, int]) -> Reference | None:
    colour, numbers = code_of(words[1]) if len(words) > 14 else None, _numbers(words[2:14])
    if colour is None or numbers is None:
        return None
    return Reference(number, colour, numbers, " ".join(words[14:]).lower().replace("\\", "/"), *kind)


def code_of(word: str) -> int | None:
    """Return the code of a colour, or the number of a direct one; None if it is neither."""
    digits = word.lower().replace("#", "0x", 1)
    try:
        code = int(digits, 16) if digits.startswith("0x") else int(digits)
    except ValueError:
        return None
    return code if 0 <= code < 1 << 26 else None


def _numbers(words: list[str]) -> tuple[float, ...] | None:
    try:
        numbers = tuple(map(float, words))
    except ValueError:
        return None
    # the comparison is also false for not-a-number
    return numbers if all(abs(number) < FARTHEST for number in numbers) else None


def _definition(words: list[str]) -> Iterator[tuple[int, tuple[int, int, int]]]:
    """Yield the code and the value that a line defines, if it is well formed."""
    pairs = dict(zip(words[3::2], words[4::2], strict=False))
    code = code_of(pairs.get("CODE", ""))
    value = code_of(pairs.get("VALUE", ""))
    if code is not None and value is not None and value <= 0xFFFFFF:
        yield code, rgb_of(value)


def rgb_of(value: int) -> tuple[int, int, int]:
    """Return the bytes of 0xRRGGBB, whatever stands before them."""
    return value >> 16 & 255, value >> 8 & 255, value & 255


def _kind(words: list[str]) -> tuple[int, int] | None:
    """Return role and piece that a comment of ours gives; None if it is not ours."""
    try:
        _, role, _, piece = words[2:]
        found = int(Role[role]), int(piece)
    except (KeyError, ValueError):
        return None
    return found if 0 <= found[1] < 2**15 else None
