"""LDraw files back to bricks: our own, and those of other programs."""

from __future__ import annotations

from .reader import SUFFIXES, LdrawModel, read_file, read_ldraw

__all__ = [
    "SUFFIXES",
    "LdrawModel",
    "read_file",
    "read_ldraw",
]
