"""What this session knows of earlier runs: in memory alone, and forgotten when another file is opened."""

from __future__ import annotations

from typing import Any, Final

import bpy
from bpy.app.handlers import persistent

from ..core.memo import Memo, Step, Trial

_BUILDS: Final = 64
"""Builds of which it is known how they were made: those made last."""


class Session:
    """Earlier runs, and which builds came of them.

    Attributes
    ----------
    memo : Memo
        Their results, as many as it may keep.
    left : set of int
        Session identifiers of copied roots that an undo has left: if they became models at once, nobody could go on.
    """

    def __init__(self) -> None:
        self.memo = Memo()
        self.left: set[int] = set()
        self._steps: dict[int, tuple[Step, ...]] = {}

    def keep(self, trial: Trial, build: bpy.types.Collection) -> None:
        """Keep what a run has found, and how a build came of it."""
        self.memo.keep(trial)
        self._steps[build.session_uid] = trial.steps()
        for uid in list(self._steps)[:-_BUILDS]:
            del self._steps[uid]

    def share(self, build: bpy.types.Collection, copy: bpy.types.Collection) -> None:
        """Note that a build is a copy of another one."""
        if build.session_uid in self._steps:
            self._steps[copy.session_uid] = self._steps[build.session_uid]

    def steps_of(self, build: bpy.types.Collection) -> tuple[Step, ...] | None:
        """Return how a build came about; None if this session has not made it."""
        return self._steps.get(build.session_uid)

    def forget(self) -> None:
        """Forget all runs."""
        self.memo.clear()
        self._steps.clear()


SESSION: Final = Session()
"""The one of this process."""


@persistent
def forget(*arguments: Any) -> None:
    """Forget all runs: another file is opened."""
    SESSION.forget()


def register() -> None:
    """Forget all when a file is opened."""
    bpy.app.handlers.load_pre.append(forget)


def unregister() -> None:
    """Undo :func:`register`, and free the memory."""
    bpy.app.handlers.load_pre.remove(forget)
    forget()
