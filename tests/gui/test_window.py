"""The add-on in a real Blender: installed from disk, its button clicked in a window on a virtual screen."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from scripts.build_extension import PYTHONS, build
from scripts.run import TREE

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "out" / "window"  # kept to be looked at
pytestmark = [pytest.mark.gui, pytest.mark.slow]


@pytest.fixture(scope="module")
def tree() -> Path:
    """Return the Debian tree with a real Blender; skip where nobody has set it up, but never in CI."""
    if not (TREE / ".ready").exists():
        sentence = "NO REAL WINDOW WAS TESTED: set it up by python3 scripts/run.py window"
        pytest.fail(sentence) if "CI" in os.environ else pytest.skip(sentence)
    return TREE


@pytest.fixture(scope="module")
def place(tree: Path) -> Iterator[Path]:
    """Return a folder inside the tree with the zip, the sample and the steps; removed in the end."""
    place = Path(tempfile.mkdtemp(prefix="legorize-", dir=tree / "tmp"))
    # the Python of a newer Debian than ours has its libraries from there
    [extension] = build(["linux-x64"], ROOT / "dist", wheels=python_of(tree) in PYTHONS)
    shutil.copy(extension, place / "legorize.zip")
    shutil.copy(ROOT / "assets" / "sample.glb", place)
    shutil.copy(Path(__file__).with_name("drive.py"), place)
    yield place
    shutil.rmtree(place)


@pytest.fixture(scope="module")
def seen(tree: Path, place: Path) -> dict[str, Any]:
    """Install the zip from disk, go through the steps in a window, and return what was seen."""
    inside = f"/{place.relative_to(tree)}"
    install = ["extension", "install-file", "-r", "user_default", "-e", f"{inside}/legorize.zip"]
    run_inside(tree, inside, "blender", "--command", *install)
    screen = ["xvfb-run", "-a", "-s", "-screen 0 1600x900x24 -nolisten tcp"]
    window = ["blender", "--gpu-backend", "opengl", "--enable-event-simulate", "-p", "0", "0", "1600", "900"]
    run_inside(tree, inside, *screen, *window, "-P", f"{inside}/drive.py", "--", f"{inside}/sample.glb", inside)
    return json.loads((place / "seen.json").read_text(encoding="utf-8"))


def python_of(tree: Path) -> str:
    """Return the version of Python in a tree, such as 3.13."""
    line = ["chroot", str(tree), "python3", "-c", "import sys; print('{}.{}'.format(*sys.version_info))"]
    return subprocess.run(line, capture_output=True, text=True, check=True).stdout.strip()


def run_inside(tree: Path, inside: str, *command: str) -> None:
    """Run a command inside the tree with a Blender that knows nothing of any user; its pictures are kept."""
    own = [f"HOME={inside}", f"BLENDER_USER_RESOURCES={inside}/user", "LANG=C.UTF-8", "LIBGL_ALWAYS_SOFTWARE=1"]
    path = "PATH=/usr/sbin:/usr/bin:/sbin:/bin"
    line = ["chroot", str(tree), "env", "-i", path, *own, "timeout", "-s", "KILL", "900", *command]
    done = subprocess.run(line, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    PICTURES.mkdir(parents=True, exist_ok=True)
    for picture in (tree / inside.lstrip("/")).glob("*.png"):
        shutil.copy(picture, PICTURES)
    assert done.returncode == 0, done.stdout[-3000:]


def picture(place: Path, name: str) -> np.ndarray:
    """Return a picture of the screen, shape (height, width, 3), int16."""
    return np.asarray(Image.open(place / f"{name}.png").convert("RGB")).astype(np.int16)


def viewport(place: Path, name: str, region: list[int]) -> np.ndarray:
    """Return the part of a picture left of the sidebar and at its height, where the model is."""
    x, y, _, height = region
    whole = picture(place, name)
    return whole[len(whole) - y - height : len(whole) - y, 60:x]


def sidebar(place: Path, name: str, region: list[int]) -> np.ndarray:
    """Return the part of a picture in which the tab is."""
    x, y, width, height = region
    whole = picture(place, name)
    return whole[len(whole) - y - height : len(whole) - y, x : x + width]


def vivid(pixels: np.ndarray) -> float:
    """Return the share of pixels with a strong colour."""
    return float((np.ptp(pixels, axis=-1) > 60).mean())


def test_tab_is_there(seen: dict[str, Any], place: Path) -> None:
    """The sidebar has the tab with its letters, and the screen is neither black nor plain."""
    assert seen["tab"] == "Legorize"
    assert len(np.unique(picture(place, "1-before").reshape(-1, 3), axis=0)) > 100
    assert (sidebar(place, "1-before", seen["region"]).min(axis=-1) > 180).sum() > 300


def test_click_makes_bricks(seen: dict[str, Any]) -> None:
    """One click on the button leaves one build with a collection a layer, beside the untouched sample."""
    assert seen["before"]["builds"] == 0
    assert seen["after"]["builds"] == 1
    assert seen["after"]["bricks"] > 300
    assert seen["after"]["layers"] > 10
    for each in ("vertices", "polygons"):
        assert seen["after"][each] == seen["before"][each]


def test_bricks_are_seen(seen: dict[str, Any], place: Path) -> None:
    """The window shows the bricks, in colours that the plain solid view of the sample did not have."""
    before, after = (viewport(place, name, seen["region"]) for name in ("1-before", "2-bricks"))
    changed = (np.abs(after - before).max(axis=-1) > 20).mean()
    assert changed > 0.03
    assert vivid(after) > vivid(before) + 0.01


def test_undo_gives_the_scene_back(seen: dict[str, Any], place: Path) -> None:
    """Ctrl-Z takes the bricks away, and nothing else."""
    assert seen["undone"] == seen["before"]
    after, undone = (viewport(place, name, seen["region"]) for name in ("2-bricks", "3-undone"))
    assert vivid(undone) < vivid(after)


def test_progress_is_shown(seen: dict[str, Any], place: Path) -> None:
    """While it runs, a bar stands where the button was."""
    top = [sidebar(place, name, seen["region"])[:100] for name in ("1-before", "4-running")]
    assert (np.abs(top[1] - top[0]).max(axis=-1) > 20).mean() > 0.02


def test_progress_never_goes_back(seen: dict[str, Any]) -> None:
    """One bar over all stages, which only grows; from the second stage on there is a time left."""
    stages, shares, left = zip(*seen["told"], strict=True)
    assert list(shares) == sorted(shares)
    assert len(set(stages)) > 2
    later = [seconds for stage, share, seconds in seen["told"] if share > 0.2 and stage != stages[0]]
    assert later
    assert None not in later
    assert left[0] is None


def test_settings_make_room_for_the_bar(seen: dict[str, Any], place: Path) -> None:
    """While it runs, the panel has the bar alone, and those below it come up: nothing can be set."""
    before, running = (sidebar(place, name, seen["region"]) for name in ("5-cancelled", "4-running"))
    assert (running.min(axis=-1) > 150).sum() < 0.5 * (before.min(axis=-1) > 150).sum()


def test_stopped_job_says_that_nothing_was_changed(seen: dict[str, Any], place: Path) -> None:
    """One line below the button is left of it, and for a while one in the status bar."""
    assert seen["said"] == "Stopped: nothing was changed."
    before, after = (picture(place, name)[-20:, :300] for name in ("1-before", "5-cancelled"))
    assert (after.min(axis=-1) > 100).sum() > (before.min(axis=-1) > 100).sum() + 100


def test_copy_is_removed_by_itself(seen: dict[str, Any], place: Path) -> None:
    """A model that was duplicated in the outliner outlives its copy, brick by brick."""
    for each in ("builds", "bricks", "instances"):
        assert seen["copied"][each] == 2 * seen["small"][each] > 0
    assert seen["copy_removed"] == seen["small"]
    assert vivid(viewport(place, "7-copy-removed", seen["region"])) > 0.02


def test_original_of_a_deleted_model_is_a_click_away(seen: dict[str, Any]) -> None:
    """After "Delete Hierarchy" the tab offers the hidden original; a click shows and selects it."""
    assert seen["hidden"]
    assert seen["deleted"]["builds"] == 0
    assert seen["shown_again"] == seen["before"]
    assert len(seen["selected"]) == 1


def test_moved_model_is_built_again_where_it_is(seen: dict[str, Any]) -> None:
    """A model that was moved by hand stays there, and so does the heat map."""
    assert np.linalg.norm(np.subtract(seen["moved"], seen["unmoved"])) > 0.05
    assert seen["rebuilt"] == pytest.approx(seen["moved"], abs=1e-4)
    assert seen["heat_map"]


def test_view_selected_frames_the_bricks(seen: dict[str, Any], place: Path) -> None:
    """With the root selected, the key brings the whole model into view, whose middle is looked at."""
    framed, (x, y, z) = seen["framed"], seen["moved"]
    assert framed["looked_at"] == pytest.approx([x, y, z + framed["height"] / 2], abs=0.1 * framed["height"])
    assert 1 < framed["distance"] / framed["height"] < 5
    assert vivid(viewport(place, "10-view-selected", seen["region"])) > 0.02


def test_bricks_are_edited_by_clicks(seen: dict[str, Any], place: Path) -> None:
    """Two bricks are picked and locked, one recoloured; Ctrl-Z takes a change back, and a build makes the others."""
    assert seen["picked"] == [1, 2]
    assert seen["locked"] == [["lock", ""]] * 2
    assert [kind for kind, _ in seen["recoloured"]][-1] == "recolour"
    assert seen["edit_undone"] == seen["locked"] == seen["edits_rebuilt"]
    orange = np.abs(viewport(place, "13-picked", seen["region"]) - (255, 140, 0)).max(axis=-1) < 60
    assert orange.sum() > 100


def test_escape_cancels(seen: dict[str, Any]) -> None:
    """Esc ends a big run and leaves the scene as it was."""
    assert seen["cancelled"] == seen["before"]


def test_model_of_somebody_else_is_opened_with_its_table(seen: dict[str, Any]) -> None:
    """An LDraw file becomes a build, whose table has a row for each part and colour; a row can be chosen."""
    assert seen["opened"] == "Legorize wall"
    assert seen["lots"] == [["3005", 4, 3], ["3005", 15, 3]]
