"""Numbers with their nouns."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from legorize_addon.core.estimate import Estimate
from legorize_addon.core.settings import Settings
from legorize_addon.ui import counts, expectation, panels

pytestmark = pytest.mark.usefixtures("addon")

NOUNS = {
    counts.bricks: ("1 brick", "2 bricks", "0 bricks"),
    counts.layers: ("1 layer", "2 layers", "0 layers"),
    counts.kinds_of_parts: ("1 kind of part", "2 kinds of parts", "0 kinds of parts"),
    counts.colours: ("1 colour", "2 colours", "0 colours"),
    counts.steps: ("1 building step", "2 building steps", "0 building steps"),
    counts.slices: ("1 slice", "2 slices", "0 slices"),
}


@pytest.mark.parametrize("count", NOUNS)
def test_one_is_singular(count) -> None:
    """One of a thing has its noun in the singular; none and several have it in the plural."""
    assert tuple(count(number) for number in (1, 2, 0)) == NOUNS[count]


def test_a_number_may_be_written_otherwise() -> None:
    """What is shown in the place of the digits does not decide between singular and plural."""
    assert counts.bricks(12345, "12,300") == "12,300 bricks"
    assert counts.bricks(1, "1") == "1 brick"


def test_a_brick_has_a_result_in_the_singular() -> None:
    """The figures of a model of one brick count one kind of part, one colour and one layer."""
    summary = {"studs_x": 4, "studs_y": 2, "layers": 1, "bricks": 1, "mass": 2.3, "parts": 1, "colours": 1}
    assert panels._figures(summary)[:3] == ("1 brick, 2 g", "1 kind of part, 1 colour", "4 x 2 studs, 1 layer")


def test_an_estimate_of_a_brick_is_in_the_singular(monkeypatch) -> None:
    """So does what the settings come to."""
    told = Estimate((4.0, 2.0), 1, (3.2, 1.6, 1.0), 8.0, 1, 150.0, {"layout": 1.0})
    monkeypatch.setattr("legorize_addon.core.estimate.estimate_of", lambda measured, settings: told)
    monkeypatch.setattr(expectation, "_measured", lambda mesh, up: None)
    lines = expectation._lines.__wrapped__(SimpleNamespace(), Settings())
    assert lines[0] == "4 x 2 studs, 1 layer"
    assert lines[2].startswith("about 1 brick, ")
