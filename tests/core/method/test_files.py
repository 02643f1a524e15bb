"""The files that show the method."""

from __future__ import annotations

from legorize_addon.core.method.files import TREE, method_files
from legorize_addon.core.method.unit_models import initial_model
from tests.core.any_bricks import CATALOGUE
from tests.core.method.drafts import draft


def test_all_files_are_there():
    """A tree, two models, and two maps a layer; progress never goes back."""
    told = []
    files = dict(
        method_files(
            draft(), None, title="tubes", shown="sides", catalogue=CATALOGUE,
            progress=lambda stage, share: told.append((stage, share)),
        )
    )  # fmt: skip
    maps = [f"{folder}/{number:03}.svg" for folder in ("hollowing", "trajectories") for number in range(1, 6)]
    assert sorted(files) == sorted([TREE, "hollowing.ldr", "unit-bricks.ldr", *maps])
    assert all(files[name].startswith("<svg ") for name in maps)
    parts = [line for line in files["unit-bricks.ldr"].splitlines() if line.startswith("1 ")]
    assert len(parts) == len(initial_model(draft().grid, CATALOGUE))
    shares = [share for _, share in told]
    assert shares == sorted(shares)
    assert {stage for stage, _ in told} == {"trajectories", "hollowing"}
