"""Legorize: turn a textured mesh into a buildable brick model.

``core/`` is the method and needs no Blender; the modules beside this one are
the only ones that know of it, so that ``legorize_addon.core`` can be imported
anywhere.
"""

from __future__ import annotations


def register() -> None:
    """Register everything with Blender."""
    from . import export_operators, learning_operators, operators, panels, properties

    properties.register()
    operators.register()
    export_operators.register()
    learning_operators.register()
    panels.register()


def unregister() -> None:
    """Undo :func:`register`; a running job is stopped."""
    from . import export_operators, learning_operators, operators, panels, properties

    panels.unregister()
    learning_operators.unregister()
    export_operators.unregister()
    operators.unregister()
    properties.unregister()
