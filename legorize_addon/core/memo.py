"""What earlier runs have found, so that a run with other settings computes only what these reach.

A stage is a function of its inputs, of the settings that it asks for, and of the random numbers that it draws. What it
asked for is written down while it works. A later run takes its result over if every input, every answer, and the state
of the random numbers are the same to the last bit, and then sets these numbers to the state that they had after it. So
a run with a memo gives exactly what it gives without one: nobody declares which setting reaches which stage.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, Protocol, TypeVar

from .sameness import inner, same, weight

LIMIT: Final = 400_000_000
"""Bytes that a memo keeps at most: a tenth of what a model of the largest size that is built without asking takes."""

Look = Callable[[str], Any]
"""Answers a question of a stage, such as ``"settings.width"``."""

Result = TypeVar("Result")


class Recall(Protocol):
    """Does a work that depends on its inputs alone, or returns what came of it before."""

    def __call__(self, name: str, inputs: tuple[Any, ...], work: Callable[[], Result]) -> Result:
        """See :meth:`Trial.call`."""
        ...


def plainly(name: str, inputs: tuple[Any, ...], work: Callable[[], Result]) -> Result:
    """Do a work, whatever was found before."""
    return work()


@dataclass(frozen=True, slots=True, eq=False)
class Entry:
    """One result, and all that it depends on.

    Attributes
    ----------
    name : str
        Of what computed it.
    stage : str
        In which this was.
    inputs : tuple
        What it was given.
    asked : mapping of str to object
        The answers to its questions.
    output : object
    left : mapping of str to object
        What else it changed, such as the state of the random numbers, by the question that asks for it.
    """

    name: str
    stage: str
    inputs: tuple[Any, ...]
    asked: Mapping[str, Any]
    output: Any
    left: Mapping[str, Any]

    def fits(self, inputs: tuple[Any, ...], look: Look) -> bool:
        """Tell whether it would be found again."""
        return all(same(value, look(asked)) for asked, value in self.asked.items()) and same(self.inputs, inputs)


@dataclass(frozen=True, slots=True, eq=False)
class Step:
    """What a later run may reach of an earlier one, without its results.

    Attributes
    ----------
    stage : str
    asked : mapping of str to object
        The answers to its questions, without what earlier steps left.
    after : frozenset of int
        Rows of the steps whose results it was given.
    """

    stage: str
    asked: Mapping[str, Any]
    after: frozenset[int]


class Memo:
    """Results of earlier runs: those that were used longest ago go first when they become too many.

    Parameters
    ----------
    limit : int, optional
        Bytes to keep at most.
    """

    def __init__(self, limit: int = LIMIT) -> None:
        self.limit = limit
        self._entries: tuple[Entry, ...] = ()
        # by identity of an entry: looking through all of them takes as long as a small stage
        self._weights: dict[int, Mapping[int, int]] = {}
        self.nbytes = 0
        """Bytes that the entries took when they were kept: arrays and tables that several of them share count once."""

    def __len__(self) -> int:
        """Return the number of results."""
        return len(self._entries)

    def __bool__(self) -> bool:
        """Return True: an empty memo is one as well."""
        return True

    @property
    def entries(self) -> tuple[Entry, ...]:
        """The results, what was used last at the end."""
        return self._entries

    def trial(self, *, afresh: bool = False) -> Trial:
        """Return a run's view of the memo, which changes nothing here until it is kept.

        Parameters
        ----------
        afresh : bool, optional
            Whether the run takes nothing over.
        """
        return Trial(() if afresh else self._entries)

    def keep(self, trial: Trial) -> None:
        """Take over what a run has found, and forget what was used longest ago if that is too much."""
        recent = trial.entries
        known = set(map(id, recent))
        entries = [each for each in self._entries if id(each) not in known] + recent
        weights = {id(each): self._weights.get(id(each)) or _weights(each) for each in entries}
        self._entries, self.nbytes = _lightest(entries, weights, self.limit)
        self._weights = {id(each): weights[id(each)] for each in self._entries}

    def clear(self) -> None:
        """Forget everything."""
        self._entries, self._weights, self.nbytes = (), {}, 0


def _weights(entry: Entry) -> dict[int, int]:
    """Return how many bytes each object in an entry takes, by its identity."""
    return {id(each): weight(each) for each in inner((entry.inputs, entry.asked, entry.output, entry.left))}


def _lightest(
    entries: Sequence[Entry], weights: Mapping[int, Mapping[int, int]], limit: int
) -> tuple[tuple[Entry, ...], int]:
    """Return the last entries that take no more bytes than allowed, and how many these are."""
    kept: list[Entry] = []
    seen: set[int] = set()
    total = 0
    for entry in reversed(entries):
        new = weights[id(entry)]
        more = sum(size for key, size in new.items() if key not in seen)
        if total + more > limit:
            break
        seen |= new.keys()
        total += more
        kept.append(entry)
    return tuple(reversed(kept)), total


class Trial:
    """What one run takes from a memo, and what it adds.

    Parameters
    ----------
    known : sequence of Entry
        Results of earlier runs, the last one last.

    Attributes
    ----------
    stage : str
        The stage at work.
    entries : list of Entry
        What this run has used or found, in order.
    """

    def __init__(self, known: Sequence[Entry]) -> None:
        self._known: dict[str, list[Entry]] = {}
        for entry in known:
            self._known.setdefault(entry.name, []).append(entry)
        self._taken: set[int] = set()
        self.entries: list[Entry] = []
        self.stage = ""

    def find(self, name: str, inputs: tuple[Any, ...], look: Look) -> Entry | None:
        """Return an earlier result with the same inputs and answers; None if there is none."""
        for entry in reversed(self._known.get(name, [])):
            if entry.fits(inputs, look):
                if id(entry) not in self._taken:
                    self._use(entry)
                return entry
        return None

    def add(self, name: str, inputs: tuple[Any, ...], asked: Mapping[str, Any], output: Any, **left: Any) -> None:
        """Note a result."""
        entry = Entry(name, self.stage, inputs, asked, output, left)
        # runs within one run may find it again
        self._known.setdefault(name, []).append(entry)
        self._use(entry)

    def call(self, name: str, inputs: tuple[Any, ...], work: Callable[[], Result]) -> Result:
        """Do a work that depends on its inputs alone, or return what came of it before.

        Parameters
        ----------
        name : str
            Of the work.
        inputs : tuple
            All that it depends on.
        work : callable
        """
        entry = self.find(name, inputs, _nothing)
        if entry is not None:
            return entry.output  # type: ignore[no-any-return]
        output = work()
        self.add(name, inputs, {}, output)
        return output

    def steps(self) -> tuple[Step, ...]:
        """Return what a later run may reach of this one."""
        shared = {id(each) for entry in self.entries for each in inner(entry.asked)}
        maker: dict[int, int] = {}
        leaver: dict[str, int] = {}
        found = []
        for row, entry in enumerate(self.entries):
            made_of = {maker[id(each)] for each in inner(entry.inputs) if id(each) in maker}
            made_of |= {leaver[asked] for asked in entry.asked if asked in leaver}
            own = {asked: value for asked, value in entry.asked.items() if asked not in leaver}
            found.append(Step(entry.stage, own, frozenset(made_of)))
            for each in inner(entry.output):
                # what it only passes on was made before
                if id(each) not in shared and _is_made(each):
                    maker.setdefault(id(each), row)
            leaver |= dict.fromkeys(entry.left, row)
        return tuple(found)

    def _use(self, entry: Entry) -> None:
        self._taken.add(id(entry))
        self.entries.append(entry)


def _nothing(asked: str) -> None:
    """Answer no question."""


def _is_made(thing: Any) -> bool:
    """Tell whether a value is an object that a stage has made, not one that all share, such as a small number."""
    return hasattr(thing, "__dataclass_fields__") or type(thing).__module__ == "numpy"


def reached(steps: Sequence[Step], look: Look) -> tuple[str, ...]:
    """Return the stages that a run may have to compute again, in their order, each once.

    Parameters
    ----------
    steps : sequence of Step
        Of an earlier run.
    look : callable
        Answers their questions in the new run.

    Returns
    -------
    tuple of str
        A stage that is computed again may find the same; then those after it are not reached.
    """
    again: set[int] = set()
    for row, step in enumerate(steps):
        if step.after & again or not all(same(value, look(asked)) for asked, value in step.asked.items()):
            again.add(row)
    return tuple(dict.fromkeys(steps[row].stage for row in sorted(again)))
