"""What importers print is not for the user, and a crash still says that it was one."""

from __future__ import annotations

import logging
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from legorize_addon.reading.quiet import quiet

ROOT = Path(__file__).resolve().parents[3]
IMPORT = "import ctypes, os, sys\nfrom legorize_addon.reading.quiet import quiet\n"


def run(code: str) -> subprocess.CompletedProcess[str]:
    """Run Python code in a process of its own."""
    # lines wait in buffers, as they do for users
    env = {key: value for key, value in os.environ.items() if key != "PYTHONUNBUFFERED"}
    return subprocess.run(
        [sys.executable, "-c", IMPORT + code],
        cwd=ROOT,
        env=env,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


@pytest.mark.skipif(os.name != "posix", reason="the library of C goes by another name")
def test_nothing_is_printed_by_python_or_below_it() -> None:
    """Lines of Python and of the libraries below are hidden, those before and after are not."""
    done = run(
        "print('before')\n"
        "with quiet():\n"
        "    print('hidden'); print('hidden', file=sys.stderr)\n"
        "    os.write(1, b'hidden'); os.write(2, b'hidden')\n"
        "    ctypes.CDLL(None).puts(b'hidden')\n"
        "    os.system('echo hidden; echo hidden >&2')\n"
        "print('after'); print('error', file=sys.stderr)\n"
    )
    assert done.stdout.split() == ["before", "after"]
    assert done.stderr.split() == ["error"]


def test_what_was_printed_can_be_looked_at() -> None:
    """Lines of libraries are there at the end."""
    with quiet() as said:
        os.write(2, b"ignoring face\n")
    assert bytes(said) == b"ignoring face\n"


@pytest.mark.skipif(os.name != "posix", reason="signals as exit status")
def test_crash_keeps_its_cause() -> None:
    """A process that a library aborts says so, and where."""
    done = run("with quiet():\n    os.write(2, b'hidden')\n    os.abort()\n")
    assert done.returncode == -signal.SIGABRT
    assert "Aborted" in done.stderr
    assert "hidden" not in done.stderr


def test_exception_passes(capfd: pytest.CaptureFixture[str]) -> None:
    """An exception comes through, and what is printed after it is shown again."""

    def fail() -> None:
        with quiet():
            os.write(1, b"hidden")
            raise ValueError("told")

    with pytest.raises(ValueError, match="told"):
        fail()
    os.write(1, b"shown")
    assert capfd.readouterr().out == "shown"


def test_log_handler_may_outlive_it(capfd: pytest.CaptureFixture[str]) -> None:
    """A handler that an importer leaves at its log writes without an error later."""
    log = logging.getLogger("importer of a test")
    with quiet():
        log.addHandler(logging.StreamHandler(sys.stderr))
    log.error("late")
    log.handlers.clear()
    assert capfd.readouterr().err == ""
