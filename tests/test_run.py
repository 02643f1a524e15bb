"""The set-up script: finds its Python, reads the pins, and says in one sentence what is missing."""

from __future__ import annotations

import sys
import time
from pathlib import Path

import pytest

from scripts import run


def test_pins_of_a_blender_include_what_the_extension_ships() -> None:
    """Included groups are flattened: an environment has one bpy, the big ones every wheel of their Python too."""
    for blender, python in run.PYTHONS.items():
        pins = run._pins(f"blender-{blender}")
        assert len([pin for pin in pins if pin.startswith("bpy==")]) == 1
        assert blender == "4.2" or set(run._pins("runtime-cp" + python.replace(".", ""))) <= set(pins)


def test_finds_a_python_of_the_wanted_version() -> None:
    """The running Python is taken for a Blender that has this Python."""
    running = ".".join(map(str, sys.version_info[:2]))
    for blender in (name for name, python in run.PYTHONS.items() if python == running):
        assert run._find(blender) == (blender, sys.executable)


@pytest.mark.parametrize("there", [[], ["/no/such/python"], [sys.executable]])
def test_missing_python_is_one_sentence(
    there: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without a fitting Python the script says so and ends with status 3."""
    monkeypatch.setattr(run, "_pythons", lambda version: iter(there))
    monkeypatch.setattr(run, "PYTHONS", {"4.5": "3.9"})
    monkeypatch.setattr(sys, "argv", ["run.py", "test"])
    assert run.main() == 3
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err == "Legorize needs Python 3.9, but none was found on this machine: install it first.\n"


def test_failed_installation_is_one_sentence(tmp_path: Path) -> None:
    """What pip says last becomes part of one sentence."""
    fake = tmp_path / "python"
    fake.write_text("#!/bin/sh\necho 'first line' >&2\necho 'no such package' >&2\nexit 1\n")
    fake.chmod(0o755)
    with pytest.raises(run.Missing, match=r"could not be installed; pip says: no such package$"):
        run._install(fake, ["nothing==0"])


def test_missing_system_library_is_named(tmp_path: Path) -> None:
    """A library that Blender's module cannot open is named, with the command that installs it."""
    fake = tmp_path / "python"
    fake.write_text("#!/bin/sh\necho 'ImportError: libXi.so.6: cannot open shared object file' >&2\nexit 1\n")
    fake.chmod(0o755)
    with pytest.raises(run.Missing, match=r"needs the system library libXi\.so\.6.*apt-get install .*libxi6"):
        run._try_blender(fake)


def test_status_is_handed_on(capsys: pytest.CaptureFixture[str]) -> None:
    """The exit status of a command is the script's; a signal is named, and its number added to 128."""
    assert run._run([sys.executable, "-c", "raise SystemExit(5)"]) == 5
    assert capsys.readouterr().err == ""
    assert run._run([sys.executable, "-c", "import os; os.kill(os.getpid(), 9)"]) == 137
    assert capsys.readouterr().err.endswith("was ended by the signal SIGKILL.\n")


def test_command_that_hangs_is_killed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A command that takes too long is ended together with what it started."""
    pulse = tmp_path / "pulse"
    child = f"import time\nfor _ in range(600): open({str(pulse)!r}, 'a').write('.'); time.sleep(0.05)"
    code = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {child!r}])"
    monkeypatch.setattr(run, "LIMIT", 2)
    with pytest.raises(run.Missing, match=r"did not end within .* minutes and was stopped"):
        run._run([sys.executable, "-c", code])
    beats = len(pulse.read_text())
    assert beats > 0
    time.sleep(0.5)
    assert len(pulse.read_text()) == beats


def test_dask_is_installed_where_it_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its pins are a group of their own, and go into the environment that is there."""
    installed = []
    monkeypatch.setattr(run, "_find", lambda blender: ("5.2", sys.executable))
    monkeypatch.setattr(run, "_environment", lambda blender, python: Path("own"))
    monkeypatch.setattr(run, "_install", lambda own, pins: installed.append((own, pins)))
    for words in (["setup"], ["setup", "--dask"]):
        monkeypatch.setattr(sys, "argv", ["run.py", *words])
        assert run.main() == 0
    [(own, pins)] = installed
    assert own == Path("own")
    assert {pin.split("==")[0] for pin in pins} >= {"dask", "distributed"}
