"""What all stages of a run are given, and how a memo learns what each of them depends on."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from copy import deepcopy
from dataclasses import dataclass
from inspect import getattr_static
from types import FunctionType, MethodType
from typing import Any, Concatenate, Final, ParamSpec, Self, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from .arrays import Mask
from .colours import chosen_palette
from .estimate import AGAIN
from .layout import FILLER
from .layout.learning import NO_EXCHANGES, grades_text, learned_table, samples_text
from .memo import Recall, Trial, plainly
from .model import Catalogue, load_catalogue
from .part_choice import PartChoice
from .progress import Overall
from .settings import Settings

Inputs = ParamSpec("Inputs")
Result = TypeVar("Result")

_PASSED: Final = frozenset({"progress", "timings", "learning", "ties", "trial"})
"""What a stage may use that its result does not depend on, or that it writes."""

_OPENED: Final = frozenset({"settings", "parts"})
"""What is asked for piece by piece."""


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """What all stages of a run are given.

    Attributes
    ----------
    settings : Settings
    catalogue : Catalogue
    parts : PartChoice
        What the layout prefers.
    palette : (n,) int16 array
        Codes of the colours to use.
    filler : int
        Code of the colour of hidden bricks.
    exchanges : (4, 16, 16, 24) bool array or None
        What the quick layout exchanges; None for what was learned from the
        shipped samples.
    training : str
        Contents of the training file that the settings name; empty without one.
    rng : numpy.random.Generator
    progress : Overall
        Of the stage at work.
    timings : dict of str to float
        CPU seconds of the stages that are done.
    learning : list of str
        What was done in each step of the learned fill.
    ties : list of int
        How many more parts there are since parts were tied.
    trial : Trial or None
        What earlier runs have found.
    """

    settings: Settings
    catalogue: Catalogue
    parts: PartChoice
    palette: NDArray[np.int16]
    filler: int
    exchanges: Mask | None
    training: str
    rng: np.random.Generator
    progress: Overall
    timings: dict[str, float]
    learning: list[str]
    ties: list[int]
    trial: Trial | None = None

    @classmethod
    def of(cls, settings: Settings, progress: Overall, trial: Trial | None = None) -> Self:
        """Return a run that begins."""
        catalogue = load_catalogue()
        palette = chosen_palette(settings.palette, catalogue)
        parts, rng = PartChoice.of(settings, catalogue), np.random.default_rng(settings.seed)
        exchanges, training = _trained(settings)
        filler = _filler(palette, catalogue)
        return cls(settings, catalogue, parts, palette, filler, exchanges, training, rng, progress, {}, [], [], trial)

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Announce a stage and note its CPU seconds; a repeated stage is added to the first one."""
        shown = name.removesuffix(AGAIN)
        if self.trial is not None:
            self.trial.stage = shown
        start = time.process_time()
        with self.progress.stage(name, shown=shown):
            yield
        self.timings[shown] = self.timings.get(shown, 0.0) + time.process_time() - start

    def once(
        self, work: Callable[Concatenate[Run, Inputs], Result], *inputs: Inputs.args, **options: Inputs.kwargs
    ) -> Result:
        """Do a work, or return what came of it before, if it would be the same now.

        Parameters
        ----------
        work : callable
            A function of a run and some inputs. It must not change its inputs, nor depend on anything else.
        *inputs, **options
            Of the work.

        Returns
        -------
        object
            What the work returns.
        """
        if self.trial is None:
            return work(self, *inputs, **options)
        name, given = f"{work.__module__}.{work.__qualname__}", (*inputs, options)
        entry = self.trial.find(name, given, self.answer)
        if entry is None:
            asked: dict[str, Any] = {}
            told = list(self.learning)
            output = work(cast("Run", _Witness(self, (asked,))), *inputs, **options)
            self.trial.add(name, given, asked, output, **self._changed(asked, told))
            return output
        if "rng" in entry.left:
            self.rng.bit_generator.state = entry.left["rng"]
        if "learning" in entry.left:
            self.learning[:] = entry.left["learning"]
        return cast("Result", entry.output)

    def _changed(self, asked: dict[str, Any], told: list[str]) -> dict[str, Any]:
        """Return what a work has left besides its result."""
        left: dict[str, Any] = {}
        if "rng" in asked:
            left["rng"] = self.answer("rng")
        if self.learning != told:
            left["learning"] = tuple(self.learning)
        return left

    def answer(self, asked: str) -> Any:
        """Return the answer to a question, such as ``"settings.width"``; of the random numbers their state."""
        if asked == "rng":
            return deepcopy(self.rng.bit_generator.state)
        found: Any = self
        for name in asked.split("."):
            found = getattr(found, name)
        return found

    @property
    def recall(self) -> Recall:
        """What does a work that depends on its inputs alone, or returns what came of it before."""
        return plainly if self.trial is None else self.trial.call


class _Witness:
    """Stands for a run, or a part of it, while a work is done, and notes the answers that it gives.

    Parameters
    ----------
    of : object
        The run itself, or the witness of a larger work, which notes the answers as well.
    notes : tuple of dict of str to object, optional
        Take the answers, by their questions.
    path : str, optional
        Question by which the object is reached.
    """

    __slots__ = ("_notes", "_of", "_path")

    def __init__(self, of: Any, notes: tuple[dict[str, Any], ...], path: str = "") -> None:
        inside = isinstance(of, _Witness)
        self._of = of._of if inside else of
        self._notes = (*notes, *of._notes) if inside else notes
        self._path = path

    def __getattr__(self, name: str) -> Any:
        found = getattr_static(type(self._of), name, None)
        # settings answer questions such as whether there may be supports: the answer counts, not what it follows from
        opened = not self._path.startswith("settings")
        if opened and isinstance(found, FunctionType):
            return MethodType(found, self)
        if opened and isinstance(found, property):
            return cast("Callable[[Any], Any]", found.fget)(self)
        value = getattr(self._of, name)
        if isinstance(found, staticmethod) or (not self._path and name in _PASSED):
            return value
        if not self._path and name in _OPENED:
            return _Witness(value, self._notes, f"{name}.")
        answer = deepcopy(value.bit_generator.state) if name == "rng" else value
        for notes in self._notes:
            # what random numbers were before the work counts
            notes.setdefault(self._path + name, answer)
        return value


def _trained(settings: Settings) -> tuple[Mask | None, str]:
    """Return what was learned from the user's samples, if that is asked for, or nothing, and the file's contents."""
    if not settings.learned_from:
        return (None if settings.learned else NO_EXCHANGES), ""
    # a wrong file is reported now, not when another layout is chosen
    text = (grades_text if settings.layout == "learned" else samples_text)(settings.learned_from)
    if settings.layout == "fast" and settings.learned:
        return learned_table(settings.learned_from), text
    return (None if settings.learned else NO_EXCHANGES), text


def _filler(palette: NDArray[np.int16], catalogue: Catalogue) -> int:
    """Return the colour of hidden bricks: the usual one, or the colour of the palette in which most parts exist."""
    if FILLER in palette:
        return FILLER
    made = catalogue.exists_in(np.flatnonzero(catalogue.used_for("model"))[:, None], palette).sum(axis=0)
    return int(palette[made.argmax()])
