"""The zip that users install: built, validated, installed in a fresh Blender, and used."""

from __future__ import annotations

import ast
import json
import os
import platform
import re
import subprocess
import sys
import tomllib
from email import message_from_bytes
from pathlib import Path
from zipfile import ZipFile

import pytest

from scripts.build_extension import HERE, PYTHONS, build, sizes

ROOT = Path(__file__).resolve().parents[1]
PLATFORM = HERE.get((platform.system(), platform.machine()), "")
pytestmark = [pytest.mark.slow, pytest.mark.skipif(not PLATFORM, reason="no wheels for this machine")]


@pytest.fixture(scope="module")
def extension(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the validated zip for this machine; building raises where Blender's tool refuses it."""
    [path] = build([PLATFORM], folder(tmp_path_factory.mktemp("built")))
    return path


def folder(place: Path) -> Path:
    """Return a folder to build in, which shares the downloaded wheels and nothing else."""
    wheels = ROOT / "dist" / "wheels"
    wheels.mkdir(parents=True, exist_ok=True)
    (place / "wheels").symlink_to(wheels)
    return place


def test_same_sources_same_bytes(extension: Path, tmp_path: Path) -> None:
    """A second build, in another folder, gives the same file."""
    [again] = build([PLATFORM], folder(tmp_path))
    assert again.read_bytes() == extension.read_bytes()


def test_zip_holds_what_runs_and_no_more(extension: Path) -> None:
    """The package, its data, the licence and the wheels; no tests, scripts, samples or numpy."""
    names = ZipFile(extension).namelist()
    assert {"__init__.py", "blender_manifest.toml", "LICENSE", "assets/parts.csv"} <= set(names)
    package = (path for path in (ROOT / "legorize_addon").rglob("*") if path.suffix in {".py", ".css", ".js", ".dat"})
    sources = {path.relative_to(ROOT).as_posix() for path in package}
    assert sources == {name for name in names if name.startswith("legorize_addon/")}
    assert not [name for name in names if re.match(r"(tests|scripts)/|wheels/numpy|assets/sample|.*\.py[co]$", name)]


def test_entry_point_hands_on_registration(extension: Path) -> None:
    """The staged entry point imports both functions from the package, relatively."""
    [_, line, _] = ast.parse(ZipFile(extension).read("__init__.py")).body
    assert (line.level, line.module, [name.name for name in line.names]) == (
        1,
        "legorize_addon",
        ["register", "unregister"],
    )


def test_zip_brings_all_that_its_wheels_require(extension: Path, tmp_path: Path) -> None:
    """For each Python every required distribution but numpy is among the wheels, and the manifest names them all."""
    zipped = ZipFile(extension)
    wheels = [name for name in zipped.namelist() if name.endswith(".whl")]
    listed = tomllib.loads(zipped.read("blender_manifest.toml").decode())["wheels"]
    assert sorted(f"./{name}" for name in wheels) == sorted(listed)
    for python in PYTHONS:
        tag = "cp" + python.replace(".", "")
        fitting = [name for name in wheels if f"-{tag}-" in name or "-py3-" in name]
        brought, required = set(), set()
        for name in fitting:
            with ZipFile(zipped.extract(name, tmp_path)) as wheel:
                [metadata] = [each for each in wheel.namelist() if each.endswith(".dist-info/METADATA")]
                fields = message_from_bytes(wheel.read(metadata))
            brought.add(normal(fields["Name"]))
            lines = fields.get_all("Requires-Dist") or []
            required |= {normal(re.match(r"[\w.-]+", line)[0]) for line in lines if "extra ==" not in line}
        assert "scikit-learn" in brought
        assert required - brought == {"numpy"}


def test_zip_for_one_python_is_half_as_large(extension: Path, tmp_path: Path) -> None:
    """It has the wheels of that Python and those for any, and says what they take."""
    [path] = build([PLATFORM], folder(tmp_path), python="3.13")
    assert path.name == extension.name.replace(".zip", "-python3.13.zip")
    all_wheels, wheels = (
        {name for name in ZipFile(each).namelist() if "wheels/" in name} for each in (extension, path)
    )
    assert wheels == {name for name in all_wheels if "-cp311-" not in name} < all_wheels
    assert path.stat().st_size < 0.6 * extension.stat().st_size
    *lines, whole = sizes(path).splitlines()
    assert whole.endswith(": all")
    assert sum(float(line.split()[0]) for line in lines) == pytest.approx(
        float(whole.split()[0]), abs=0.05 * len(lines)
    )
    assert sum(name.endswith(".whl") for name in wheels) == len(lines) - 1


def test_installed_from_disk(extension: Path, tmp_path: Path) -> None:
    """In a Blender that knows nothing of the user's, the zip installs, legorizes, and leaves when switched off."""
    script = Path(__file__).with_name("installed_extension.py")
    own = os.environ | {"BLENDER_USER_RESOURCES": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, str(script), str(extension)], env=own, capture_output=True, text=True, check=False, timeout=240
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout.strip().splitlines()[-1])
    assert found["enabled"]
    assert found["status"] == ["FINISHED"]
    assert found["bricks"] > 10
    assert found["source_faces"] == 6
    assert found["palette"] == "4, 15"
    assert found["left_behind"] == []
    assert Path(found["own_folder"]).parts[-4:] == (".user", "user_default", "legorize", "learned")
    # it is the libraries of the zip that were used, not those of this environment
    assert all(Path(file).is_relative_to(tmp_path) for file in found["libraries"].values())


def normal(name: str) -> str:
    """Return the name of a distribution as its index compares it."""
    return re.sub(r"[-_.]+", "-", name).lower()
