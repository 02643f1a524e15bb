"""What the tests inside Blender share: every test begins with an empty file, unless it is about numbers alone."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

bpy = pytest.importorskip("bpy", reason="needs Blender as a Python module")


@pytest.fixture(autouse=True)
def empty_file(request: pytest.FixtureRequest) -> None:
    """Open an empty file, unless only numbers are tested; unlike read_factory_settings this keeps add-ons enabled."""
    if "numbers" not in request.keywords:
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


@pytest.fixture(scope="module")
def addon() -> Iterator[None]:
    """Register the add-on for the tests of a file."""
    import legorize_addon

    legorize_addon.register()
    yield
    legorize_addon.unregister()
