"""Names that a package offers before their modules are loaded."""

from __future__ import annotations

import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from legorize_addon.core.on_demand import on_demand

ROOT = Path(__file__).resolve().parents[2]
CORE = ROOT / "legorize_addon" / "core"
OFFERING = sorted(
    ".".join(path.parent.relative_to(ROOT).parts)
    for path in CORE.rglob("__init__.py")
    if "__all__" in path.read_text(encoding="utf-8")
)


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Return the name of a package with a light name, and a heavy one that waits."""
    (tmp_path / "sample_house").mkdir()
    entry = "from legorize_addon.core.on_demand import on_demand\nlight = 1\n"
    entry += "__getattr__ = on_demand(__name__, cellar=('heavy', 'gone'))\n"
    (tmp_path / "sample_house" / "__init__.py").write_text(entry, encoding="utf-8")
    (tmp_path / "sample_house" / "cellar.py").write_text("heavy = object()\n", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    for name in ("sample_house", "sample_house.cellar"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    return "sample_house"


def test_module_waits_for_its_name(package: str) -> None:
    """The light name leaves the module alone; the heavy one loads it, and is the same thing ever after."""
    house = import_module(package)
    assert house.light == 1
    assert f"{package}.cellar" not in sys.modules
    heavy = house.heavy
    assert heavy is sys.modules[f"{package}.cellar"].heavy
    assert vars(house)["heavy"] is heavy


def test_unknown_names_stay_unknown(package: str) -> None:
    """What nobody offers is an error of Python's own kind, so that hasattr and imports of modules work as ever."""
    house = import_module(package)
    assert not hasattr(house, "attic")
    with pytest.raises(AttributeError, match="'sample_house' has no attribute 'attic'"):
        _ = house.attic
    with pytest.raises(ImportError):
        exec("from sample_house import attic")
    # offered, but not there: the module's fault, told as such
    with pytest.raises(AttributeError, match="gone"):
        _ = house.gone


def test_first_module_with_a_name_is_asked() -> None:
    """Each name is looked for in the module that offers it."""
    found = on_demand("legorize_addon.core", units=("STUD",), errors=("MeshError",))
    assert found("STUD") == import_module("legorize_addon.core.units").STUD
    assert found("MeshError") is import_module("legorize_addon.core.errors").MeshError
    # found stands in the package from then on
    core = import_module("legorize_addon.core")
    del core.STUD, core.MeshError


def printed(code: str) -> str:
    """Return what a fresh Python prints."""
    command = [sys.executable, "-c", code]
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True, timeout=60).stdout


def test_packages_have_all_they_offer() -> None:
    """Every name of every package of the core is there, before and after it was loaded."""
    assert "legorize_addon.core.model" in OFFERING
    for package in map(import_module, OFFERING):
        assert not [name for name in package.__all__ if not hasattr(package, name)], package


def test_light_names_load_nothing_heavy() -> None:
    """What a scene takes of the core comes without scipy."""
    code = """
import sys
from legorize_addon.core.building import Action, Moves
from legorize_addon.core.model import Bricks, Role
print("scipy" in sys.modules)
from legorize_addon.core.model import contact_graph
print("scipy" in sys.modules)
"""
    assert printed(code).split() == ["False", "True"]
