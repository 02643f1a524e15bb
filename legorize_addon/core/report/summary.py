"""What a run prints at its end: the model, the files, and the verdict."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import Any, Final

from ..progress import duration
from ..units import count_of

_VERDICTS: Final = {
    "stable": "the model is proven to stand",
    "wedged": "the model is proven to stand only while neighbouring bricks press on each other",
    "collapses": "the model is proven to collapse",
    "undecided": "the model is not proven to stand",
}


def summary(facts: dict[str, Any], folder: str, files: Iterable[str]) -> tuple[str, ...]:
    """Say what was built, which files were written, and whether the model is good.

    Parameters
    ----------
    facts : dict
        The report, with ``failed_checks``.
    folder : str
        Folder of the files, as the user named it.
    files : iterable of str
        Paths in this folder, with ``/`` between their parts.

    Returns
    -------
    tuple of str
        Three lines. The lines of the failed checks are not among them.
    """
    bricks, layers = count_of(facts["counts"]["bricks"], "brick", "bricks"), facts["grid"]["layers"]
    steps, removed = facts["building"]["steps"], facts["supports"]["removed"]
    below = f", with {count_of(removed, 'temporary support brick', 'temporary support bricks')}" if removed else ""
    failed = facts["failed_checks"]
    checks = f"{count_of(len(failed), 'check', 'checks')} failed" if failed else "every check passed"
    size = " x ".join(f"{length:.1f}" for length in facts["size"]["cm"])
    return (
        f"Model: {bricks} in {count_of(layers, 'layer', 'layers')}, {size} cm, {facts['mass_g']:.0f} g, built in "
        f"{count_of(steps, 'step', 'steps')} and about {duration(facts['building_time_s'])}{below}.",
        f"Files in {folder}: {', '.join(_shortened(files))}.",
        f"Verdict: {_VERDICTS[facts['stability']['verdict']]}; {checks}.",
    )


def _shortened(files: Iterable[str]) -> list[str]:
    """Return the names of files, and for each folder in it how many it holds."""
    heads = Counter(path.split("/")[0] + "/" * ("/" in path) for path in files)
    return [f"{name} ({count})" if name.endswith("/") else name for name, count in sorted(heads.items())]
