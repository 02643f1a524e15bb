"""Stopped at any moment, a run ends with the status of the signal, and nothing is left of it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
SCRIPT = ROOT / "scripts" / "legorize.py"
SAMPLE = ROOT / "assets" / "sample.glb"
STATUS = {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGHUP: 129}

# what a run waits at, so that the moment is the same on every machine: it says so and waits for the signal
IN_PYTHON = "import time; open(HERE, 'w').close(); [time.sleep(0.01) for _ in range(100_000)]"
PLACES = {
    "imports": f"import builtins; real = builtins.__import__\n"
    f"def slow(name, *rest):\n    if name == 'bpy':\n        {IN_PYTHON}\n    return real(name, *rest)\n"
    f"builtins.__import__ = slow",
    "core": f"from legorize_addon.core.report import outputs\ndef wait(*arguments, **more):\n    {IN_PYTHON}\n"
    f"outputs.write_ldr = wait",
    "importer": f"import io_scene_gltf2\nfrom io_scene_gltf2.io.imp import gltf2_io_gltf\n"
    f"def read(self):\n    {IN_PYTHON}\ngltf2_io_gltf.glTFImporter.read = read",
    "swallowed": "from legorize_addon.core.report import outputs\ndef wait(*arguments, **more):\n"
    "    open(HERE, 'w').close()\n    while True:\n"
    "        try:\n            import time; time.sleep(100)\n        except KeyboardInterrupt:\n            pass\n"
    "outputs.write_ldr = wait",
}


def started(place: str, out: Path, before: str = "") -> subprocess.Popen[str]:
    """Start a run that stops at a place, and wait until it is there."""
    first = "" if place == "imports" else "import bpy; bpy.ops.wm.read_homefile(use_factory_startup=True)\n"
    path = f"import sys; sys.path.insert(0, {str(ROOT)!r})\n"
    argv = [str(SCRIPT), str(SAMPLE), "--out", str(out), "--width", "6"]
    here = out.parent / "here"
    code = f"HERE = {str(here)!r}\n{before}\n{path}{first}{PLACES[place]}\nimport runpy; sys.argv = {argv!r}\n"
    code += f"runpy.run_path({str(SCRIPT)!r}, run_name='__main__')"
    run = subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    while not here.exists():
        assert run.poll() is None, run.communicate()
        time.sleep(0.02)
    here.unlink()
    return run


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("number", STATUS)
def test_stopped_run_leaves_nothing(place: str, number: int, tmp_path: Path) -> None:
    """While it imports, computes, reads a file, or where the stop is swallowed: the old folder and nothing else."""
    out = tmp_path / "out"
    out.mkdir()
    (out / "mine.ldr").write_text("earlier")
    run = started(place, out)
    assert place in ("imports", "importer") or len(list(tmp_path.glob(".legorize-*"))) == 1
    run.send_signal(number)
    _, said = run.communicate(timeout=120)
    assert run.returncode == STATUS[number]
    assert "Traceback" not in said or place == "importer"
    assert "cannot be read" not in said
    assert [path.relative_to(tmp_path).as_posix() for path in sorted(tmp_path.rglob("*"))] == ["out", "out/mine.ldr"]


def test_second_signal_does_not_disturb(tmp_path: Path) -> None:
    """Ctrl-C pressed again and again is one stop."""
    run = started("core", tmp_path / "out")
    for number in (signal.SIGINT, signal.SIGINT, signal.SIGTERM, signal.SIGINT):
        run.send_signal(number)
    _, said = run.communicate(timeout=120)
    assert run.returncode in (130, 143)
    assert said.splitlines()[-1] == "Stopped: nothing was written."
    assert list(tmp_path.iterdir()) == []


def test_nohup_lets_it_run(tmp_path: Path) -> None:
    """Who asked to go on after the end of the terminal is not stopped by it."""
    run = started("core", tmp_path / "out", "import signal; signal.signal(signal.SIGHUP, signal.SIG_IGN)")
    run.send_signal(signal.SIGHUP)
    with pytest.raises(subprocess.TimeoutExpired):
        run.wait(1)
    run.send_signal(signal.SIGTERM)
    run.communicate(timeout=120)
    assert run.returncode == 143


def test_blender_leaves_no_folder_either(tmp_path: Path) -> None:
    """The folder of Blender's own for temporary files is gone, too."""
    (tmp_path / "temporary").mkdir()
    before = os.environ.get("TMPDIR")
    os.environ["TMPDIR"] = str(tmp_path / "temporary")
    try:
        run = started("core", tmp_path / "out")
    finally:
        del os.environ["TMPDIR"]
        if before is not None:
            os.environ["TMPDIR"] = before
    assert len(list((tmp_path / "temporary").iterdir())) == 1
    run.send_signal(signal.SIGINT)
    run.communicate(timeout=120)
    assert list((tmp_path / "temporary").iterdir()) == []


@pytest.mark.parametrize("where", ["> /dev/full", ">&-", "2>&-", "2> /dev/full", "| true", ">&- 2>&- <&-"])
def test_nobody_reads_the_output(where: str, tmp_path: Path) -> None:
    """A full disk, a closed pipe or no output at all change neither the results nor the status."""
    line = f"{sys.executable} {SCRIPT} {SAMPLE} --out {tmp_path / 'out'} --width 4"
    shell = f"set -o pipefail; {line} {where}"
    done = subprocess.run(["bash", "-c", shell], capture_output=True, text=True, timeout=240, check=False)
    assert done.returncode == 0, done.stderr
    texts = [path for path in (tmp_path / "out").rglob("*") if path.is_file()]
    assert len(texts) > 10
    assert not [path for path in texts if "INFO" in path.read_text() or " bricks in " in path.read_text()]
