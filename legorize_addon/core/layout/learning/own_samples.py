"""Files of samples: the chosen one, and a new version with samples of a user's own models.

A file is never changed. Learning writes a new one, which has all samples of the
one before and those of further models, and a version one higher; so every earlier
layout can be repeated.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Final

import numpy as np

from ...arrays import Mask
from ...errors import BuildError
from ...model import ASSETS, Bricks, Catalogue, UnitGrid
from ...safe_text import one_line
from .sample_file import MOST_MODELS, MOST_SAMPLES, SHIPPED_VERSION, checked_text, parameter, whole
from .svm import Samples, read, table_of
from .svm_training import samples_of, train, written

EACH: Final = 60
"""Samples taken from each model."""

_ADVICE: Final = "choose a file that Learn from Models wrote, or leave it empty."
_KEPT: Final = 4
"""Machines of files that are kept."""


def learned_table(path: str) -> Mask:
    """Return what the machine of a file of samples proposes.

    Parameters
    ----------
    path : str
        The file; empty for the one that is shipped.

    Returns
    -------
    (4, 16, 16, 24) bool array
        As :meth:`~.svm.Machine.table`.

    Raises
    ------
    SettingsError
        It is no file of samples.
    """
    return _table(samples_text(path))


@lru_cache(maxsize=_KEPT)
def _table(text: str) -> Mask:
    return table_of(text)


def samples_text(path: str) -> str:
    """Read a file of samples.

    Parameters
    ----------
    path : str
        The file; empty for the one that is shipped.

    Returns
    -------
    str
        Its text, which :func:`~.svm.read` reads.

    Raises
    ------
    SettingsError
        It cannot be read, or is no file of samples.
    """
    return checked_text(path, ASSETS / "layout_svm.csv", lambda text: read(text)[1], _ADVICE)


def version_of(text: str) -> int:
    """Return the version of a file of samples."""
    return whole(read(text)[1], "version", SHIPPED_VERSION)


def learn_more(
    text: str,
    models: Sequence[tuple[UnitGrid, Bricks]],
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
    models : sequence of (UnitGrid, Bricks)
        Hollowed models, and their layouts by the fast tier without learning.
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
        The new file: the samples so far, in their order, then the new ones. C and gamma do not change; the share of
        right predictions is found by cross-validation over models.

    Raises
    ------
    BuildError
        The models give too few samples, or with those before they are too many.
    """
    before, facts = read(text)
    if len(before.pays) + EACH * len(models) > MOST_SAMPLES or before.model.max() + len(models) >= MOST_MODELS:
        raise BuildError(
            f"The file of samples is full with {len(before.pays)} samples: leave learned_from empty to begin anew."
        )
    more = samples_of(models, catalogue, rng, EACH * len(models))
    samples = Samples(
        np.concatenate([before.levels, more.levels]),
        np.concatenate([before.pays, more.pays]),
        np.concatenate([before.model, more.model + before.model.max() + 1]),
    )
    trained = train(samples, rng, costs=[parameter(facts, "C")], gammas=[parameter(facts, "gamma")])
    # a name must fit into one line here
    learned = ", ".join(map(one_line, names))
    kept = {name: facts[name] for name in ("what", "formulation") if name in facts}
    origin = f"those of version {version_of(text)} ({facts.get('models', 'unknown')}), then {learned}"
    return written(trained, {**kept, "made by": "learning from models", "version": str(version), "models": origin})
