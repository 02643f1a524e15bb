"""What all tests share: repeatable hypothesis runs, and a Blender that knows nothing of the user's own."""

from __future__ import annotations

import os
import tempfile

from hypothesis import settings

settings.register_profile("repeatable", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("repeatable")

# read when bpy is imported, which no test module does before this file
_resources = tempfile.TemporaryDirectory(prefix="legorize-tests-")
os.environ["BLENDER_USER_RESOURCES"] = _resources.name


def pytest_unconfigure() -> None:
    """Clear up here, since a run with Blender may end without the interpreter's own exit."""
    _resources.cleanup()
