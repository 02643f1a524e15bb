"""The limits on the size of models: what is larger than users allow is refused before the work."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

from .errors import BuildError, LimitError
from .estimate import Estimate, megabytes
from .model import Assembly, Bricks, Role, load_catalogue
from .settings import Settings
from .shopping import shopping_list


def check_limits(expected: Estimate, settings: Settings) -> None:
    """Refuse what is larger than the settings allow.

    The limits are numbers that users can raise, not the memory that happens to be free: the same file and settings are
    built, or refused, on every machine.

    Parameters
    ----------
    expected : Estimate
        Of a mesh with these settings.
    settings : Settings

    Raises
    ------
    LimitError
        One sentence with the size, what it would cost, and what to change.
    """
    spent = _spent(expected)
    passed = {name: spent[name] / limit for name, limit in _limits(settings).items() if spent[name] > limit}
    if not passed:
        return
    raised = [f"{name} to {_rounded_up(spent[name])}" for name in passed]
    cure = f"choose {_smaller(settings, passed)}"
    if all(_rounded_up(spent[name]) <= _highest(name) for name in passed):
        cure += ", or raise " + " and ".join(raised)
    raise LimitError(f"{expected.sentence()}: {cure}.")


def within_limits(expected: Estimate, settings: Settings) -> Settings:
    """Return settings whose limits allow the expected model, as far as their ranges permit."""
    spent = _spent(expected)
    passed = [name for name, limit in _limits(settings).items() if spent[name] > limit]
    raised: dict[str, Any] = {name: min(_rounded_up(spent[name]), _highest(name)) for name in passed}
    return replace(settings, **raised)


def check_size(bricks: Bricks, settings: Settings) -> None:
    """Refuse models that the limits do not allow, before anything is computed of them.

    Raises
    ------
    BuildError
        There are no bricks, or none but supports that are taken out again.
    LimitError
        There are too many, or they lie too far apart.
    """
    if (bricks.role == Role.SUPPORT_OUTSIDE).all():
        raise BuildError("There are no bricks: open a file with bricks and plates.")
    found = shopping_list(Assembly(bricks, load_catalogue()))
    longest = max(found.cm)
    if longest > settings.limit_size:
        raise LimitError(
            f"The model is {longest:,.0f} cm long, more than the limit of {settings.limit_size:,} cm: remove parts "
            "that lie far away, or raise limit_size."
        )
    if len(bricks) > settings.limit_bricks:
        raise LimitError(
            f"The model has {len(bricks):,} bricks, more than the limit of {settings.limit_bricks:,}: open a smaller "
            "one, or raise limit_bricks."
        )
    needed = megabytes(found.studs[0] * found.studs[1] * found.plates, len(bricks))
    if needed > settings.limit_memory:
        raise LimitError(
            f"The model would take about {needed:,.0f} MB, more than the limit of {settings.limit_memory:,} MB: remove "
            "parts that lie far away, or raise limit_memory."
        )


def _limits(settings: Settings) -> dict[str, int]:
    """Return the limits by the names of their settings."""
    return {
        "limit_size": settings.limit_size,
        "limit_bricks": settings.limit_bricks,
        "limit_memory": settings.limit_memory,
    }


def _spent(expected: Estimate) -> dict[str, float]:
    """Return the value that is compared with each limit."""
    return {"limit_size": max(expected.cm), "limit_bricks": expected.bricks, "limit_memory": expected.megabytes}


def _highest(name: str) -> int:
    """Return how far a limit can be raised."""
    [highest] = [entry.metadata["high"] for entry in fields(Settings) if entry.name == name]
    return int(highest)


def _rounded_up(number: float) -> int:
    """Return two digits that are no less than a number."""
    step: int = 10 ** max(0, math.floor(math.log10(max(number, 1))) - 1)
    return math.ceil(number / step) * step


def _smaller(settings: Settings, passed: Mapping[str, float]) -> str:
    """Return the size that would do, in words: the number of bricks grows with the area at least, the memory too."""
    share = min(1 / ratio ** (1.0 if name == "limit_size" else 0.5) for name, ratio in passed.items())
    name = settings.size_by
    fitting = getattr(settings, name) * share
    if name == "cm":
        return f"{fitting:.3g} cm or less"
    if name == "scale":
        step = 10.0 ** (math.floor(math.log10(fitting)) - 1)
        return f"a scale of {math.floor(fitting / step) * step:g} or less"
    return f"a {name} of {math.floor(fitting)} or less" if fitting >= 1 else f"a size by something else than {name}"
