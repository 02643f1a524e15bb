"""Switching the add-on on: quick, since what takes seconds to import waits until something is built."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HEAVY = {"scipy", "sklearn", "joblib", "xatlas"}

# 4.5 hangs at the interpreter's own exit
REGISTER = """
import os, sys
import bpy
import legorize_addon
legorize_addon.register()
view = bpy.context.scene.legorize
looked_at = [view.top_layer, view.heat_map, view.step, bpy.ops.legorize.build.poll()]
print("LOADED", *sorted({name.split(".")[0] for name in sys.modules}))
sys.stdout.flush()
os._exit(0)
"""


def test_registering_imports_nothing_heavy() -> None:
    """Neither switching the add-on on nor looking at its panel loads what only building needs."""
    done = subprocess.run(
        [sys.executable, "-c", REGISTER], cwd=ROOT, check=True, timeout=120, capture_output=True, text=True
    )
    [line] = [line for line in done.stdout.splitlines() if line.startswith("LOADED")]
    loaded = set(line.split())
    assert {"bpy", "numpy", "legorize_addon"} <= loaded
    assert not loaded & HEAVY
