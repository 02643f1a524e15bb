"""Files of samples of the learned fill: the chosen one, and a new version with samples of a user's own models.

As for the exchanges of the fast layout (:mod:`.own_samples`), a file is never
changed: a new version has all samples of the one before.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from ...errors import BuildError
from ...model import ASSETS, Catalogue, UnitGrid
from ...safe_text import one_line
from .grade_training import balanced, fewest, graded_of, train_grades, written_grades
from .grading import Graded, Grader, grader_of, read_graded
from .sample_file import MOST_MODELS, MOST_SAMPLES, SHIPPED_VERSION, checked_text, parameter, whole

EACH: Final = 20
"""Samples of each grade that are taken from a model, at most."""

_FEWEST: Final = 2
"""Samples of each grade that all models together must give."""

_ADVICE: Final = "choose a file that Learn from Models wrote for the learned layout, or leave it empty."


def grades_text(path: str) -> str:
    """Read a file of samples of the learned fill.

    Parameters
    ----------
    path : str
        The file; empty for the one that is shipped.

    Returns
    -------
    str
        Its text, which :func:`~.grading.read_graded` reads.

    Raises
    ------
    SettingsError
        It cannot be read, or is no such file.
    """
    return checked_text(path, ASSETS / "fill_svm.csv", lambda text: read_graded(text)[1], _ADVICE)


def grades_version(text: str) -> int:
    """Return the version of a file of samples."""
    return whole(read_graded(text)[1], "version", SHIPPED_VERSION)


def learned_grader(path: str) -> tuple[Grader, dict[str, str]]:
    """Return the machine of a file of samples, and the facts of the file.

    Parameters
    ----------
    path : str
        The file; empty for the one that is shipped.

    Returns
    -------
    Grader
    dict of str to str

    Raises
    ------
    SettingsError
        It is no file of samples.
    """
    text = grades_text(path)
    return grader_of(text), read_graded(text)[1]


def learn_more_grades(
    text: str,
    grids: Sequence[UnitGrid],
    catalogue: Catalogue,
    rng: np.random.Generator,
    *,
    names: Sequence[str],
    version: int,
) -> str:
    """Add samples of further models to those of a file, and judge the machine that learns from all.

    Parameters
    ----------
    text : str
        The file so far.
    grids : sequence of UnitGrid
        Hollowed models.
    catalogue : Catalogue
        Parts and colours.
    rng : numpy.random.Generator
        Draws the samples.
    names : sequence of str
        Of the models, for people.
    version : int
        Of the new file.

    Returns
    -------
    str
        The new file: the samples so far, in their order, then the new ones, as many of each grade, none of which was
        there. Decisions are those of the machine so far, and three in ten by chance; the exact fill of their windows
        labels them. C and gamma do not change; the share of right answers is found by cross-validation over models.

    Raises
    ------
    BuildError
        The models give too few samples, or with those before they are too many.
    """
    before, facts = read_graded(text)
    if len(before.grade) + 3 * EACH * len(grids) > MOST_SAMPLES or before.model.max() + len(grids) >= MOST_MODELS:
        raise BuildError(
            f"The file of samples is full with {len(before.grade)} samples: leave learned_from empty to begin anew."
        )
    pool = graded_of(grids, catalogue, rng, choose=grader_of(text).choose, known=before)
    fresh = pool.take(np.arange(len(pool.grade)) >= len(before.grade))
    fresh = Graded(fresh.energies, fresh.grade, fresh.model + before.model.max() + 1)
    count = min(fewest(fresh), EACH * len(grids))
    if count < _FEWEST:
        raise BuildError(
            f"The models give {count} samples of a grade, fewer than {_FEWEST}: choose more or larger models."
        )
    more = balanced(fresh, rng, count)
    samples = Graded(*(np.concatenate([getattr(each, name) for each in (before, more)]) for name in Graded.__slots__))
    trained = train_grades(samples, rng, costs=[parameter(facts, "C")], gammas=[parameter(facts, "gamma")])
    # a name must fit into one line here
    learned = ", ".join(map(one_line, names))
    kept: dict[str, str] = {name: facts[name] for name in ("what", "formulation") if name in facts}
    origin = f"those of version {grades_version(text)} ({facts.get('models', 'unknown')}), then {learned}"
    return written_grades(
        trained, {**kept, "made by": "learning from models", "version": str(version), "models": origin}
    )
