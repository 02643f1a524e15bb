"""The learned fill, the exchanges of the fast layout, and the files of their training samples."""

from __future__ import annotations

from .fill import decided, fill_upwards
from .grading import Grader, shipped_grader
from .layer import Layer
from .own_samples import learn_more, learned_table, samples_text, version_of
from .svm import NO_EXCHANGES, improved, read, shipped

__all__ = [
    "NO_EXCHANGES",
    "Grader",
    "Layer",
    "decided",
    "fill_upwards",
    "improved",
    "learn_more",
    "learned_table",
    "read",
    "samples_text",
    "shipped",
    "shipped_grader",
    "version_of",
]
