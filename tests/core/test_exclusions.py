"""Settings that exclude each other are refused in one sentence that names both."""

from __future__ import annotations

import pytest

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.settings import Settings


@pytest.mark.parametrize(
    "values",
    [
        {"open_bottom": True, "hollow": False},
        {"dithering": "ordered", "one_to_one": True},
        {"dithering": "diffusion", "cell_colour": "longest"},
        {"surface": "slopes", "layout": "learned"},
        {"half_studs": True, "plates": "none"},
        {"half_studs": True, "layout": "learned"},
        {"hollow_rule": "upper", "hollow": False},
    ],
)
def test_contradictions_are_refused(values):
    """Both names are told; each of the two values alone is allowed."""
    with pytest.raises(SettingsError) as raised:
        Settings(**values)
    for name, value in values.items():
        assert name in str(raised.value)
        Settings(**{name: value})
