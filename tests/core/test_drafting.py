"""The stages before the layout."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.drafting import STAGES, draft_model
from legorize_addon.core.errors import SettingsError
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from tests.core.solids import box, joined, sphere


def test_a_draft_is_what_a_build_begins_with():
    """Trajectories, unit bricks and scale are those of the whole build."""
    mesh, settings = sphere(4, radius=30), Settings(width=8, layout="fast")
    shown = []
    made = draft_model(mesh, settings, lambda stage, share: shown.append((stage, share)))
    build = legorize(mesh, settings)
    np.testing.assert_array_equal(made.trajectories.points, build.draft.trajectories.points)
    np.testing.assert_array_equal(made.grid.colour, build.grid.colour)
    assert made.scale == build.draft.scale == build.scale
    assert {stage for stage, _ in shown} <= set(STAGES)
    assert shown[-1][1] == 1.0


@pytest.mark.parametrize("size_by", ["parts", "budget"])
def test_sizes_that_building_finds_are_refused(size_by):
    """A draft has no bricks to count."""
    with pytest.raises(SettingsError, match="choose the width"):
        draft_model(sphere(4), Settings(size_by=size_by))


@pytest.mark.parametrize("size_by", ["width", "scale"])
def test_a_size_that_fits_better_is_taken_and_told_unless_it_is_a_factor(size_by):
    """A box of 9.8 studs on a beam of 20 studs by two errs less a little larger."""
    mesh = joined(box((-80, -8, 0), (80, 8, 9.6)), box((-39.2, -39.2, 9.6), (39.2, 39.2, 57.6)))
    settings = Settings(size_by=size_by, width=20, up="z", grid_fit="sizes", layout="fast", supports="none")
    build = legorize(mesh, settings)
    told = [note for note in build.notes if "% larger" in note or "% smaller" in note]
    assert bool(told) == (size_by == "width")
    assert (build.scale == pytest.approx(1.0)) == (size_by == "scale")
    # the scale that is told is that of the mesh that was built
    assert np.ptp(build.draft.mesh.vertices[:, 0]) == pytest.approx(160 * build.scale)
