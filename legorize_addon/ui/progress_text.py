"""How far a job has come, in the words of the panel and the status bar."""

from __future__ import annotations

from bpy.app.translations import pgettext_iface as iface
from bpy.app.translations import pgettext_n as n

from ..core.progress import duration

STOPPED = n("Stopped: nothing was changed.")


def progress_text(stage: str, share: float, seconds_left: float | None, *, stopping: bool) -> str:
    """Return how far all of the work has come.

    Parameters
    ----------
    stage : str
        What is being done.
    share : float
        Share of the whole work that is done.
    seconds_left : float or None
        How long the rest takes at a guess; None where nobody knows.
    stopping : bool
        Whether the work was asked to stop.

    Returns
    -------
    str
        As "Layout: 40 %, 2 min left".
    """
    if stopping:
        return iface("Stopping")
    left = "" if seconds_left is None else iface(", {} left").format(duration(seconds_left))
    return f"{iface(stage.capitalize())}: {share * 100:.0f} %{left}"
