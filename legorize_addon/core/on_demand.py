"""Names that a package offers, but whose modules are imported only at their first use.

A package's ``__init__`` runs for its lightest name too. Where some of its
modules take long to load, as those with scipy, their names wait::

    from .moves import Action, Moves

    if TYPE_CHECKING:
        from .order import ordered
    else:
        __getattr__ = on_demand(__name__, order=("ordered",))

Importing a name looks the same as always, ``from ..building import ordered``, and
type checkers see it. A name that is also that of a module in the package cannot
wait, since Python itself puts a module under its name into the package.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any


def on_demand(package: str, **modules: tuple[str, ...]) -> Callable[[str], Any]:
    """Return a ``__getattr__`` for a package that imports offered names at their first use.

    Parameters
    ----------
    package
        The package's ``__name__``.
    **modules
        The names that each of its modules offers through it.

    Returns
    -------
    Callable
        A function as PEP 562 describes it. A name that it has found stands in the package from then on.
    """
    homes = {name: module for module, names in modules.items() for name in names}

    def found(name: str) -> Any:
        """Load a name where it is told, and keep it."""
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(import_module(f"{package}.{homes[name]}"), name)
        setattr(import_module(package), name, value)
        return value

    return found
