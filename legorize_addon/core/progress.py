"""How a long computation tells how far it has come.

A progress callback is called with the name of the stage and its share done in
[0, 1]. It may raise :class:`~legorize_addon.core.errors.Cancelled`; the core
lets that through, so that a request to stop ends the run at the next call.
"""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[str, float], None]
"""Called with (stage, share done); may raise ``Cancelled``."""


def silent(stage: str, share: float) -> None:
    """Ignore the progress, for runs that nobody watches."""
