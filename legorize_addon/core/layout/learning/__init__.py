"""The support vector machine of the fast layout, and the files of its training samples."""

from __future__ import annotations

from .own_samples import learn_more, learned_table, samples_text, version_of
from .svm import NO_EXCHANGES, improved, read, shipped

__all__ = [
    "NO_EXCHANGES",
    "improved",
    "learn_more",
    "learned_table",
    "read",
    "samples_text",
    "shipped",
    "version_of",
]
