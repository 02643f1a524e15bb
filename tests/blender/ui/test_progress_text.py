"""How far a job has come, in words."""

from __future__ import annotations

import pytest

from legorize_addon.ui.progress_text import progress_text


@pytest.mark.parametrize(
    ("share", "left", "text"),
    [
        (0.004, None, "Unit bricks: 0 %"),
        (0.4, 125.0, "Unit bricks: 40 %, 2 min left"),
        (0.996, 0.2, "Unit bricks: 100 %, 1 s left"),
    ],
)
def test_share_of_all_work_and_time_left(share: float, left: float | None, text: str) -> None:
    """The stage, the share of the whole, and the time left where it is known."""
    assert progress_text("unit bricks", share, left, stopping=False) == text


def test_stopping_is_all_there_is_to_say() -> None:
    """After Esc no figure counts."""
    assert progress_text("layout", 0.5, 60.0, stopping=True) == "Stopping"
