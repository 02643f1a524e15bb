"""The end of the memory is told like any other failure that a user can mend."""

from __future__ import annotations

import pytest

from legorize_addon.core.errors import BuildError, enough_memory


def test_end_of_the_memory_becomes_a_sentence():
    """As a block and as a decorator, only the end of the memory is turned into a sentence; its cause is kept."""

    @enough_memory()
    def greedy() -> None:
        raise MemoryError

    with pytest.raises(BuildError, match=r"choose a smaller size, or close other programs\.$") as told:
        greedy()
    assert isinstance(told.value.__cause__, MemoryError)
    with pytest.raises(ZeroDivisionError), enough_memory():
        raise ZeroDivisionError
    with enough_memory():
        pass
