"""What can go wrong, each as one full sentence for the user.

``LegorizeError`` is the base of every *expected* failure: bad input, settings
that contradict each other, a model that cannot be built. Its message says what
is wrong, with the number, and what to do. Operators and scripts turn it into a
report or an exit status in one place each. Anything else is a bug and keeps its
traceback.

::

    LegorizeError
    ├── MeshError        the mesh or its images cannot be used
    ├── SettingsError    a setting, or a combination of settings, is impossible
    │   └── LimitError   the model would be larger than a limit that the user can raise
    └── BuildError       the model cannot be built or written
        ├── PartsError   the owned parts do not suffice for it
        └── EditError    an edit by hand cannot be made
    Cancelled            the user asked to stop (not a failure)
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


class LegorizeError(Exception):
    """Base of the failures that a user can understand and put right."""


class MeshError(LegorizeError):
    """The mesh, its materials or its images cannot be used."""


class SettingsError(LegorizeError):
    """A setting is out of range or contradicts another one."""


class LimitError(SettingsError):
    """The model is above a limit. The window asks whether to build it all the same."""


class BuildError(LegorizeError):
    """The model cannot be built, or its files cannot be written."""


class PartsError(BuildError):
    """The owned parts do not suffice, and nothing can be bought."""


class EditError(BuildError):
    """An edit by hand cannot be read or made."""


class Cancelled(Exception):  # noqa: N818 - a request, not an error
    """Raised by a progress callback when the user asked to stop; never caught in the core."""


@contextmanager
def enough_memory() -> Iterator[None]:
    """Turn a ``MemoryError`` into a sentence; also a decorator.

    Raises
    ------
    BuildError
        Instead of ``MemoryError``, from wherever it came.
    """
    try:
        yield
    except MemoryError as error:
        raise BuildError(
            "There is not enough memory for a model of this size: choose a smaller size, or close other programs."
        ) from error
