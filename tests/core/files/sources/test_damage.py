"""The sentence for what is damaged."""

from __future__ import annotations

from pathlib import Path

from legorize_addon.core.files.sources.damage import damaged


def test_sentence() -> None:
    """It names the file without its folder, the reason and what to do."""
    sentence = str(damaged(Path("folder/box.ply"), "its header has no end"))
    assert sentence == "box.ply is incomplete or damaged (its header has no end): export or download it again."
