"""The learned fill, the exchanges of the fast layout, and the files of their training samples."""

from __future__ import annotations

from .fill import decided, fill_upwards
from .fill_log import FillLog
from .grading import Grader, read_graded, shipped_grader
from .layer import Layer
from .own_grades import grades_text, grades_version, learn_more_grades, learned_grader
from .own_samples import learn_more, learned_table, samples_text, version_of
from .svm import NO_EXCHANGES, improved, read, shipped

__all__ = [
    "NO_EXCHANGES",
    "FillLog",
    "Grader",
    "Layer",
    "decided",
    "fill_upwards",
    "grades_text",
    "grades_version",
    "improved",
    "learn_more",
    "learn_more_grades",
    "learned_grader",
    "learned_table",
    "read",
    "read_graded",
    "samples_text",
    "shipped",
    "shipped_grader",
    "version_of",
]
