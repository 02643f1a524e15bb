"""Numbers that a node tree computes, as expressions that can be evaluated on texels or corners.

An expression is a number, or a tuple of an operation and its operands. The
leaves are ``("image", texture, channel)``, a channel of the texels of an image, and
``("attribute", name)``, the alpha of a colour attribute. As tuples, expressions
are compared and hashed by what they say.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, Final

import numpy as np

Expression = float | tuple[Any, ...]
LEAVES: Final = ("image", "attribute")


def _quotient(first: Any, second: Any) -> Any:
    """Return a quotient, 0 where it is divided by 0, as Blender does."""
    second = np.asarray(second, dtype=float)
    return np.where(second == 0, 0.0, first / np.where(second == 0, 1.0, second))


OPERATIONS: Final[dict[str, Callable[..., Any]]] = {
    "ADD": np.add,
    "SUBTRACT": np.subtract,
    "MULTIPLY": np.multiply,
    "DIVIDE": _quotient,
    "MULTIPLY_ADD": lambda a, b, c: a * b + c,
    "POWER": lambda a, b: np.power(np.maximum(a, 0.0), b),
    "SQRT": lambda a: np.sqrt(np.maximum(a, 0.0)),
    "ABSOLUTE": np.abs,
    "MINIMUM": np.minimum,
    "MAXIMUM": np.maximum,
    "LESS_THAN": lambda a, b: np.less(a, b) * 1.0,
    "GREATER_THAN": lambda a, b: np.greater(a, b) * 1.0,
    "ROUND": lambda a: np.floor(np.asarray(a) + 0.5),
    "FLOOR": np.floor,
    "CEIL": np.ceil,
    "CLAMP": lambda a: np.clip(a, 0.0, 1.0),
}
"""What Math nodes do, by Blender's names."""

OPERANDS: Final = {
    "MULTIPLY_ADD": 3, "SQRT": 1, "ABSOLUTE": 1, "ROUND": 1, "FLOOR": 1, "CEIL": 1, "CLAMP": 1,
}  # fmt: skip
"""How many operands an operation has, where it is not two."""


def operation(name: str, *operands: Expression) -> Expression:
    """Return an expression, the number itself where all operands are numbers."""
    if all(isinstance(operand, float) for operand in operands):
        return float(OPERATIONS[name](*operands))
    return (name, *operands)


def mixed(share: Expression, first: Expression, second: Expression) -> Expression:
    """Return ``first`` where the share is 0 and ``second`` where it is 1."""
    if first == second:
        return first
    return operation(
        "ADD",
        operation("MULTIPLY", operation("SUBTRACT", 1.0, share), first),
        operation("MULTIPLY", share, second),
    )


def leaves(expression: Expression) -> Iterator[tuple[Any, ...]]:
    """Yield the leaves of an expression, as often as they stand in it."""
    if isinstance(expression, float):
        return
    if expression[0] in LEAVES:
        yield expression
        return
    for operand in expression[1:]:
        yield from leaves(operand)


def evaluated(expression: Expression, leaf: Callable[[tuple[Any, ...]], Any]) -> Any:
    """Evaluate an expression, given what its leaves are: numbers or arrays that broadcast."""
    if isinstance(expression, float):
        return expression
    if expression[0] in LEAVES:
        return leaf(expression)
    return OPERATIONS[expression[0]](*(evaluated(operand, leaf) for operand in expression[1:]))


def replaced(expression: Expression, leaf: Callable[[tuple[Any, ...]], Expression]) -> Expression:
    """Return an expression with its leaves replaced by expressions."""
    if isinstance(expression, float):
        return expression
    if expression[0] in LEAVES:
        return leaf(expression)
    return operation(expression[0], *(replaced(operand, leaf) for operand in expression[1:]))
