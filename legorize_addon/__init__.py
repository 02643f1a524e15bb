"""Legorize: turn a textured mesh into a buildable brick model.

``core/`` is the method and needs no Blender; the modules beside this one are
the only ones that know of it, so that ``legorize_addon.core`` can be imported
anywhere.

Registering is quick: the core's stages load scipy and scikit-learn, which takes
seconds, so that the modules beside this one import them where their work
begins, and only the core's light modules at the top.
"""

from __future__ import annotations


def register() -> None:
    """Register everything with Blender."""
    from .ui import register as register_all

    register_all()


def unregister() -> None:
    """Undo :func:`register`; a running job is stopped."""
    from .ui import unregister as unregister_all

    unregister_all()
