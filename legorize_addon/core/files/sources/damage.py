"""The sentence for a file whose structure is damaged."""

from __future__ import annotations

from pathlib import Path

from ...errors import MeshError


def damaged(source: Path, reason: str) -> MeshError:
    """Return the error for a file that cannot be read, for a reason such as ``its header has no end``."""
    return MeshError(f"{source.name} is incomplete or damaged ({reason}): export or download it again.")
