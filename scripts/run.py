"""Set up and run Legorize from a fresh copy of the repository; only Python is needed.

::

    python3 scripts/run.py sample     legorize the bundled sample into out/sample
    python3 scripts/run.py test       run the tests (--quick: a choice of a minute; more arguments go to pytest)
    python3 scripts/run.py check      check the source with ruff and mypy
    python3 scripts/run.py docs       build the documentation into out/docs/html
    python3 scripts/run.py zip        build the extension into dist (more arguments: --platform)
    python3 scripts/run.py window     set up what the tests in a window need (root on Debian, once, 1.3 GB)
    python3 scripts/run.py release    check that a release can be made, and build it
    python3 scripts/run.py python     run the environment's Python (more arguments: a script, or -m and a module)
    python3 scripts/run.py setup      only make the environment (--dask: with Dask, for scripts/batch.py)

The first use makes an environment in ``.venv`` with the packages pinned in
pyproject.toml, Blender among them, and later uses find it there. ``--blender``
chooses between the Blenders; without it the running Python decides. The
documentation has an environment of its own, without Blender. Only the
standard library is used here. Exit status: 3 where no fitting Python is
installed, 4 where no window can be set up, 1 where something else is missing or
a command took too long, else that of the command.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import platform
import re
import shlex
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PYTHONS = {"4.5": "3.11", "5.2": "3.13", "4.2": "3.11"}  # Blender: its Python; the favourite first
DOCS = "docs"  # the environment of the documentation, beside those of the Blenders
DOCS_PYTHON = PYTHONS["5.2"]
CHECKED = "5.2"  # types are checked against the numpy of this Blender: those of older ones say less
LIMIT = 40 * 60  # seconds
NO_PYTHON = 3
NO_WINDOW = 4
TREE = Path(os.environ.get("LEGORIZE_BLENDER_TREE", "/opt/blender-trixie"))  # a Debian with a real Blender
# Blender 4.5's module hangs at exit once its glTF exporter was used, so pytest's run ends without an exit of Blender
PYTEST = "import os, sys, pytest; status = pytest.main(sys.argv[1:]); sys.stdout.flush(); os._exit(status)"


COMMANDS = ("sample", "test", "check", "window", "docs", "zip", "release", "python", "setup")
# the tests of --quick; tests/not_quick.txt names those that take too long
QUICK = ("-m", "not slow and not gui", "tests/core", "tests/scripts", "tests/test_architecture.py")


class Missing(Exception):  # noqa: N818 - a state of the machine, told in one sentence
    """Something that this machine needs is missing."""

    def __init__(self, sentence: str, status: int = 1) -> None:
        super().__init__(sentence)
        self.status = status


def main() -> int:
    """Run one command in its environment and return the exit status."""
    parser = argparse.ArgumentParser(description="Set up and run Legorize.")
    parser.add_argument("command", choices=COMMANDS)
    parser.add_argument("--blender", choices=PYTHONS, help="Blender version to use")
    own_words, python_words = _words(sys.argv[1:])
    chosen, rest = parser.parse_known_args(own_words)
    try:
        if chosen.command == "docs":
            return _docs(rest)
        blender, python = _find(chosen.blender or (CHECKED if chosen.command == "check" else None))
        if python != sys.executable:
            os.execv(python, [python, *sys.argv])  # the running Python may be too old for what follows
        own = _environment(blender, python)
        if chosen.command == "window":
            _make_tree()
        if chosen.command == "setup" and "--dask" in rest:
            _install(own, _pins("dask"))
        return max((_run([str(own), *line]) for line in _lines(chosen.command, rest or python_words)), default=0)
    except Missing as missing:
        print(missing, file=sys.stderr)
        return missing.status


def _words(words: list[str]) -> tuple[list[str], list[str]]:
    """Return what is meant for this script, and all that follows the command ``python``, flags included."""
    end = words.index("python") + 1 if "python" in words else len(words)
    return words[:end], words[end:]


def _lines(command: str, rest: list[str]) -> Iterator[list[str]]:
    """Yield the Python command lines of a command."""
    if command == "sample":
        yield ["scripts/legorize.py", "assets/sample.glb", "--out", "out/sample", "--render", *rest]
    elif command == "test":
        quick = "--quick" in rest
        rest = [word for word in rest if word != "--quick"]
        yield ["-c", PYTEST, *(_quick() if quick else ()), *rest]
    elif command == "release":
        yield ["scripts/release.py", *rest]
    elif command == "python":
        yield rest
    elif command in ("zip", "window"):  # the window gets the extension, whose wheels are downloaded once
        yield ["scripts/build_extension.py", *rest]
    elif command == "check":
        yield ["-m", "ruff", "check", *rest]
        yield ["-m", "ruff", "format", "--check", *rest]
        yield ["-m", "mypy"]


def _quick() -> list[str]:
    """Return pytest's arguments for the quick choice."""
    lines = (ROOT / "tests" / "not_quick.txt").read_text(encoding="utf-8").splitlines()
    return [*QUICK, *(f"--deselect={line}" for line in lines if line and not line.startswith("#"))]


def _docs(rest: list[str]) -> int:
    """Build the documentation in its environment, by a Python of its version."""
    python = next((each for each in _pythons(DOCS_PYTHON) if _version(each) == DOCS_PYTHON), "")
    if not python:
        raise Missing(f"The documentation needs Python {DOCS_PYTHON}, but none was found: install it first.", NO_PYTHON)
    if python != sys.executable:
        os.execv(python, [python, *sys.argv])
    return _run([str(_installed(DOCS, python)), "scripts/build_docs.py", *rest])


def _find(blender: str | None) -> tuple[str, str]:
    """Return the Blender version to use and a Python for it."""
    wanted = [blender] if blender else [name for name in PYTHONS if name != "4.2"]
    running = ".".join(map(str, sys.version_info[:2]))
    for name in sorted(wanted, key=lambda name: PYTHONS[name] != running):
        for python in _pythons(PYTHONS[name]):
            if _version(python) == PYTHONS[name]:
                return name, python
    versions = " or ".join(PYTHONS[name] for name in wanted)
    raise Missing(f"Legorize needs Python {versions}, but none was found on this machine: install it first.", NO_PYTHON)


def _pythons(version: str) -> Iterator[str]:
    """Yield programs that may be the wanted Python, the most likely first."""
    yield sys.executable
    for name in (f"python{version}", "python3", "python"):
        found = shutil.which(name)
        if found:
            yield found
    pyenv = Path(os.environ.get("PYENV_ROOT") or Path.home() / ".pyenv") / "versions"
    frameworks = Path("/Library/Frameworks/Python.framework/Versions")
    yield from map(str, sorted(pyenv.glob(f"{version}.*/bin/python"), reverse=True))
    for folder in (Path("/opt/homebrew/bin"), Path("/usr/local/bin"), frameworks / version / "bin"):
        if (folder / f"python{version}").exists():
            yield str(folder / f"python{version}")


def _version(python: str) -> str:
    """Return the version of a Python as "3.11", empty if it does not start (as a shim of another version)."""
    code = "import sys; print('.'.join(map(str, sys.version_info[:2])))"
    try:
        return subprocess.run([python, "-c", code], capture_output=True, text=True, check=False).stdout.strip()
    except OSError:
        return ""


def _environment(blender: str, python: str) -> Path:
    """Return the Python of the environment for a Blender, which is made if it is missing or out of date."""
    own = _installed(f"blender-{blender}", python)
    starts = own.parents[1] / "blender-starts"
    if not starts.exists():
        _try_blender(own)
        starts.touch()
    return own


def _make_tree() -> None:
    """Set up the Debian tree with the real Blender in which the tests of the window run, if it is missing."""
    if platform.machine() != "x86_64" or os.geteuid() != 0 or not Path("/etc/debian_version").exists():
        raise Missing(
            "The tests in a window need a Debian tree with Blender, which only root on Debian (x86_64) can make.",
            NO_WINDOW,
        )
    print(f"Setting up {TREE} (once; about two minutes, 1.3 GB) ...", flush=True)
    if _run(["sh", "tests/gui/make_blender.sh", str(TREE)]):
        raise Missing(f"The tree {TREE} could not be set up: see above.")


def _installed(group: str, python: str) -> Path:
    """Return the Python of an environment with the packages that the dependency group of the same name pins."""
    pins, folder = _pins(group), ROOT / ".venv" / group
    own, installed = folder / "bin" / "python", folder / "pins.sha256"
    digest = hashlib.sha256("\n".join(pins).encode()).hexdigest()
    if not installed.exists() or installed.read_text() != digest:
        size = "" if group == DOCS else ", some 500 MB"
        print(f"Making {folder.relative_to(ROOT)} with {len(pins)} packages (once{size}) ...", flush=True)
        _make(python, folder)
        _install(own, pins)
        installed.write_text(digest)
    return own


def _make(python: str, folder: Path) -> None:
    if subprocess.run([python, "-c", "import ensurepip, venv"], capture_output=True, check=False).returncode:
        version = _version(python)
        raise Missing(
            f"{python} cannot make virtual environments: install its venv module first "
            f"(Debian and Ubuntu: apt-get install python{version}-venv)."
        )
    subprocess.run([python, "-m", "venv", "--clear", str(folder)], check=True)


def _install(own: Path, pins: list[str]) -> None:
    pip = [str(own), "-m", "pip", "install", "--quiet", "--no-input", "--disable-pip-version-check", *pins]
    done = subprocess.run(pip, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode:
        last = (done.stderr.strip() or "no message").splitlines()[-1]
        raise Missing(f"The packages pinned in pyproject.toml could not be installed; pip says: {last}")


def _try_blender(own: Path) -> None:
    """Import Blender once, since its module needs system libraries that a bare Linux may lack."""
    done = subprocess.run([str(own), "-c", "import bpy"], stderr=subprocess.PIPE, text=True, check=False, timeout=300)
    library = re.search(r"(lib\S+\.so\S*): cannot open", done.stderr)
    if library:
        packages = (ROOT / "scripts" / "system_packages.txt").read_text().split()
        raise Missing(
            f"Blender needs the system library {library[1]}: install it first "
            f"(Debian and Ubuntu: apt-get install {' '.join(packages)})."
        )
    if done.returncode:
        last = (done.stderr.strip() or "no message").splitlines()[-1]
        raise Missing(f"Blender's module does not start in {own}; it says: {last}")


def _pins(group: str) -> list[str]:
    """Return the requirements of a dependency group of pyproject.toml, included groups first."""
    import tomllib

    groups = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["dependency-groups"]

    def flat(name: str) -> Iterator[str]:
        for entry in groups[name]:
            yield from (entry,) if isinstance(entry, str) else flat(entry["include-group"])

    return list(flat(group))


def _run(line: list[str]) -> int:
    """Run a command from the repository's root; it and what it started are killed when it takes too long."""
    process = subprocess.Popen(line, cwd=ROOT, start_new_session=True)
    try:
        status = process.wait(LIMIT)
    except BaseException as reason:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        if isinstance(reason, subprocess.TimeoutExpired):
            sentence = f"This did not end within {LIMIT // 60} minutes and was stopped: {shlex.join(line)}"
            raise Missing(sentence) from None
        raise
    if status < 0:
        print(f"{line[0]} was ended by the signal {signal.Signals(-status).name}.", file=sys.stderr)
        return 128 - status
    return status


if __name__ == "__main__":
    sys.exit(main())
