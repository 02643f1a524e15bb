"""Build and validate the extension: one zip a platform, with the wheels for every Python of Blender or for one.

::

    python scripts/build_extension.py [--platform linux-x64 ...] [--python 3.13] [--out dist]

A zip for one Python is half as large. Blender refuses it, with a sentence, on
another Python: 3.11 is in Blender 4.2 to 5.0, 3.13 in 5.1 and later and in some
distributions' own earlier ones.

Blender takes a package with ``__init__.py`` beside the manifest, while the
repository keeps the add-on in a folder of its own; so a copy is staged, with an
entry point that hands on ``register`` and ``unregister``. Only in that copy
does the manifest name platforms and wheels. Blender's own builder, found in the
installed ``bpy`` (``python3 scripts/run.py zip`` takes care of that), packs and
validates. The same sources give the same bytes.

References
----------
Blender Manual, "Creating Extensions" and "Python Wheels".
"""

from __future__ import annotations

import argparse
import json
import platform
import shutil
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterable
from importlib.util import find_spec
from pathlib import Path
from zipfile import ZipFile, ZipInfo

ROOT = Path(__file__).resolve().parents[1]

# tags that pip is to accept for each platform name of Blender's manifest
TAGS = {
    "linux-x64": ("manylinux_2_28_x86_64", "manylinux_2_27_x86_64", "manylinux2014_x86_64"),
    "macos-arm64": ("macosx_12_0_arm64",),
    "windows-x64": ("win_amd64",),
}
HERE = {("Linux", "x86_64"): "linux-x64", ("Darwin", "arm64"): "macos-arm64", ("Windows", "AMD64"): "windows-x64"}
PYTHONS = {"3.11": "runtime-cp311", "3.13": "runtime-cp313"}  # Python of a Blender: dependency group
BUILT_AT = (2026, 1, 1, 0, 0, 0)  # the time of every file in the zip

ENTRY_POINT = '''"""Where Blender enters the extension."""

from .legorize_addon import register, unregister

__all__ = ["register", "unregister"]
'''


def main() -> None:
    """Build the platforms that the command line names."""
    here = HERE.get((platform.system(), platform.machine()))
    parser = argparse.ArgumentParser(description="Build the Blender extension.")
    parser.add_argument(
        "--platform", choices=TAGS, action="append", help="can be given several times; default: this machine's"
    )
    parser.add_argument(
        "--python", choices=PYTHONS, help="only for this Python of Blender, half as large (default: for all)"
    )
    parser.add_argument(
        "--no-wheels", action="store_true", help="for a Blender whose Python has the libraries, such as Debian's own"
    )
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="folder for the zips and the cached wheels")
    chosen = parser.parse_args()
    platforms = chosen.platform or ([here] if here else [])
    if not platforms:
        parser.error(f"There are no wheels for this machine ({platform.machine()}): choose a --platform.")
    for path in build(platforms, chosen.out, python=chosen.python, wheels=not chosen.no_wheels):
        print(path)
        print(sizes(path))


def build(platforms: list[str], out: Path, *, python: str | None = None, wheels: bool = True) -> list[Path]:
    """Build one zip for each platform.

    Parameters
    ----------
    platforms : list of str
        Platform names of Blender's manifest, keys of ``TAGS``.
    out : Path
        Folder for the zips; downloaded wheels are kept in ``out/wheels``.
    python : str, optional
        Key of ``PYTHONS`` whose wheels alone are packed, instead of all.
    wheels : bool, optional
        Whether any are packed.

    Returns
    -------
    list of Path
        The validated zips, in the order of the platforms.
    """
    out.mkdir(parents=True, exist_ok=True)
    pythons, ending = ([python], f"-python{python}") if python else (list(PYTHONS), "")
    if not wheels:
        pythons, ending = [], "-no-wheels"
    return [_build_one(name, fetch_wheels(name, out / "wheels", pythons), out.resolve(), ending) for name in platforms]


def sizes(path: Path) -> str:
    """Return how large the wheels of a zip are and what they take when they are installed, in lines."""
    lines, packed, unpacked = [], 0, 0
    with ZipFile(path) as zipped:
        wheels = [entry for entry in zipped.infolist() if entry.filename.endswith(".whl")]
        for wheel in sorted(wheels, key=lambda entry: -entry.file_size):
            with zipped.open(wheel) as file, ZipFile(file) as inner:
                inside = sum(entry.file_size for entry in inner.infolist())
            lines.append(_size_line(wheel.file_size, inside, Path(wheel.filename).name))
            packed, unpacked = packed + wheel.file_size, unpacked + inside
    lines.append(_size_line(path.stat().st_size - packed, path.stat().st_size - packed, "the add-on itself"))
    lines.append(_size_line(path.stat().st_size, path.stat().st_size - packed + unpacked, "all"))
    return "\n".join(lines)


def _size_line(packed: int, unpacked: int, name: str) -> str:
    return f"{packed / 1e6:8.1f} MB, {unpacked / 1e6:6.1f} MB unpacked: {name}"


def _build_one(name: str, wheels: list[Path], out: Path, ending: str) -> Path:
    version = tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))["version"]
    path = out / f"legorize-{version}-{name}{ending}.zip"
    with tempfile.TemporaryDirectory() as folder:
        staged, packed = Path(folder) / "staged", Path(folder) / "packed.zip"
        stage(staged, name, wheels)
        _blender("build", "--source-dir", str(staged), "--output-filepath", str(packed))
        _settle(packed, path)
    tags = _blender_folder() / "modules/_bpy_internal/extensions/tags.py"
    _blender("validate", "--valid-tags", str(tags), str(path))
    return path


def fetch_wheels(name: str, folder: Path, pythons: Iterable[str] = PYTHONS) -> list[Path]:
    """Download the pinned wheels for some Pythons, those that are not in the folder yet.

    Parameters
    ----------
    name : str
        Platform name of Blender's manifest.
    folder : Path
        Where wheels are kept; each (Python, platform) has a folder of its own.
    pythons : iterable of str, optional
        Keys of ``PYTHONS``; all by default.

    Returns
    -------
    list of Path
        The wheels, no file name twice, sorted by name.
    """
    found: dict[str, Path] = {}
    for python in pythons:
        group = PYTHONS[python]
        pins, place = "\n".join(pinned(group)), folder / f"{group}-{name}"
        kept = place / "pins"
        if not kept.exists() or kept.read_text() != pins:
            shutil.rmtree(place, ignore_errors=True)
            _download(pins.split(), python, name, place)
            kept.write_text(pins)
        found |= {path.name: path for path in place.glob("*.whl")}
    return [found[file] for file in sorted(found)]


def pinned(group: str) -> list[str]:
    """Return the requirements of a dependency group of pyproject.toml, such as "scipy==1.15.3"."""
    groups = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["dependency-groups"]
    flat = []
    for entry in groups[group]:
        flat += [entry] if isinstance(entry, str) else pinned(entry["include-group"])
    return flat


def stage(folder: Path, name: str, wheels: list[Path]) -> None:
    """Lay out the extension as Blender wants it.

    Parameters
    ----------
    folder : Path
        A folder that does not exist yet.
    name : str
        Platform name of Blender's manifest.
    wheels : list of Path
        Wheel files to ship.
    """
    folder.mkdir()
    for part, leave_out in (("legorize_addon", ("__pycache__", ".*")), ("assets", (".*", "sample.*", "*.png"))):
        shutil.copytree(ROOT / part, folder / part, ignore=shutil.ignore_patterns(*leave_out))
    shutil.copy(ROOT / "LICENSE", folder)
    (folder / "__init__.py").write_text(ENTRY_POINT, encoding="utf-8")
    (folder / "wheels").mkdir()
    for wheel in wheels:
        shutil.copy(wheel, folder / "wheels")
    named = json.dumps([f"./wheels/{wheel.name}" for wheel in wheels])  # a list of JSON is one of TOML too
    # plain keys have to stand above the first table
    packed = f"wheels = {named}\n" if wheels else ""
    added = f'platforms = ["{name}"]\n{packed}\n[permissions]'
    manifest = (ROOT / "blender_manifest.toml").read_text(encoding="utf-8").replace("[permissions]", added, 1)
    (folder / "blender_manifest.toml").write_text(manifest, encoding="utf-8")


def _settle(packed: Path, path: Path) -> None:
    """Write a zip anew with its files sorted, one time for all and stored as they are.

    The builder takes files in the order of the disk and with their times; most
    bytes are in wheels, which are compressed already.
    """
    with ZipFile(packed) as source, ZipFile(path, "w") as target:
        for file in sorted(source.namelist()):
            entry = ZipInfo(file, BUILT_AT)
            entry.external_attr = 0o644 << 16
            target.writestr(entry, source.read(file))


def _download(pins: list[str], python: str, name: str, folder: Path) -> None:
    tags = [word for tag in TAGS[name] for word in ("--platform", tag)]
    pip = [sys.executable, "-m", "pip", "download", "-qq", "--disable-pip-version-check", "--no-deps"]
    only = ["--only-binary=:all:", "--implementation", "cp", "--python-version", python]
    subprocess.run([*pip, *only, *tags, "--dest", str(folder), *pins], check=True)


def _blender_folder() -> Path:
    """Return the folder "scripts" of the installed bpy, without importing it."""
    spec = find_spec("bpy")
    if spec is None or spec.origin is None:
        sys.exit("Blender's builder comes with the bpy module: run this as `python3 scripts/run.py zip`.")
    return next(Path(spec.origin).parent.glob("*/scripts"))


def _blender(*command: str) -> None:
    """Run Blender's command-line tool for extensions."""
    tool = _blender_folder() / "addons_core/bl_pkg/cli/blender_ext.py"
    subprocess.run([sys.executable, str(tool), *command], check=True)


if __name__ == "__main__":
    main()
