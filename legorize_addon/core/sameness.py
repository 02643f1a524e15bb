"""Whether two values are the same to the last bit, what they are made of, and how much memory that takes."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import cache
from typing import Any, Final

import numpy as np

_PLAIN: Final = (bool, int, float, str, bytes, type(None), Enum, np.generic)
"""Types whose values are compared as such."""

_LEAVES: Final = frozenset({bool, int, float, str, bytes, type(None)})
"""Types whose values are made of nothing else: most of what a run has found."""


def same(one: Any, other: Any) -> bool:
    """Tell whether two values are the same: the same object, or equal in every bit of every array.

    Parameters
    ----------
    one, other : object
        Plain values, arrays, tables of them, and frozen dataclasses of all these. Of anything else only the same object
        is the same: a difference too many costs time, one too few would be wrong.

    Returns
    -------
    bool
    """
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, np.ndarray):
        return _same_arrays(one, other)
    if isinstance(one, _PLAIN):
        return bool(one == other)
    if isinstance(one, Mapping):
        return list(one) == list(other) and all(same(value, other[key]) for key, value in one.items())
    if isinstance(one, (tuple, list)):
        return len(one) == len(other) and all(map(same, one, other))
    if is_dataclass(one):
        return all(same(getattr(one, entry.name), getattr(other, entry.name)) for entry in fields(one))
    return False


def _same_arrays(one: np.ndarray[Any, Any], other: np.ndarray[Any, Any]) -> bool:
    """Compare bytes: a negative zero is no zero, and not-a-number is itself."""
    if one.shape != other.shape or one.dtype != other.dtype or one.dtype.hasobject:
        return False
    return one.tobytes() == other.tobytes()


def inner(thing: Any) -> Iterator[Any]:
    """Yield a value and all that it is made of, each object once.

    Parameters
    ----------
    thing : object
        As for :func:`same`; what dataclasses have computed of themselves and keep is part of them.

    Yields
    ------
    object
    """
    waiting, seen = [thing], set[int]()
    while waiting:
        each = waiting.pop()
        if id(each) in seen:
            continue
        seen.add(id(each))
        yield each
        if type(each) in _LEAVES:
            continue
        if isinstance(each, Mapping):
            waiting += [*each.keys(), *each.values()]
        elif isinstance(each, (tuple, list, set, frozenset)):
            waiting += each
        elif isinstance(each, np.ndarray):
            waiting += [] if each.base is None else [each.base]
        elif names := _fields(type(each)):  # type: ignore[arg-type]  # a class is hashable
            kept = getattr(each, "__dict__", {})
            waiting += [*(getattr(each, name) for name in names), *kept.values()]


@cache
def _fields(kind: type) -> tuple[str, ...]:
    """Return the names of the fields of a dataclass; none of any other type."""
    return tuple(entry.name for entry in fields(kind)) if is_dataclass(kind) else ()


def weight(thing: Any) -> int:
    """Return how many bytes a value takes in memory by itself, without what it is made of."""
    if isinstance(thing, np.ndarray):
        # a view has no data of its own
        return sys.getsizeof(thing) if thing.base is None else sys.getsizeof(thing[:0])
    return sys.getsizeof(thing)
