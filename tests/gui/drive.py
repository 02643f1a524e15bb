"""Work the add-on by hand in a Blender with a window: find the tab, click the button, undo, click again, press Esc.

Run by test_window.py as ``blender --enable-event-simulate -P drive.py -- SAMPLE FOLDER``. What was seen on the way goes
into FOLDER: pictures of the screen, and ``seen.json`` once all steps are done. A failure ends Blender with status 9.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
import traceback
from collections.abc import Iterator
from typing import Any

import bpy

SAMPLE, FOLDER = sys.argv[sys.argv.index("--") + 1 :]
TAB = "Legorize"
BUTTON = "LEGORIZE_OT_build"
LIMIT = 120.0  # seconds that any one wait may take

Wait = Iterator[float]  # seconds in which Blender goes on by itself


def play(seen: dict[str, Any]) -> Wait:
    """Do all steps one after another and note what is to be seen after each."""
    sample = import_sample()
    area = view_area()
    area.spaces.active.show_region_ui = True
    yield 1.0
    region = region_of(area, "UI")
    region.active_panel_category = TAB
    frame_all(area)
    yield 1.0
    seen["tab"] = region.active_panel_category
    seen["region"] = [region.x, region.y, region.width, region.height]
    seen["before"] = scene_content(sample)
    screenshot("1-before")

    bpy.context.scene.legorize.settings.width = 48
    yield from click_button(seen)
    started = time.monotonic()
    yield from wait_until(lambda: not running())
    seen["seconds"] = time.monotonic() - started
    yield 1.0
    frame_all(area)
    yield 1.0
    seen["after"] = scene_content(sample)
    screenshot("2-bricks")

    yield from press("Z", ctrl=True)
    yield 1.0
    seen["undone"] = scene_content(sample)
    screenshot("3-undone")

    bpy.context.scene.legorize.settings.width = 120
    yield from click_button(seen)
    yield 0.2
    camera = start_screenshot("4-running")  # the work goes on meanwhile
    yield 0.3
    yield from press("ESC")
    started = time.monotonic()
    yield from wait_until(lambda: not running())
    seen["seconds_to_stop"] = time.monotonic() - started
    assert camera.wait(60) == 0
    yield 0.5
    seen["cancelled"] = scene_content(sample)
    screenshot("5-cancelled")


def import_sample() -> str:
    """Empty the scene, import the sample, select it, and return its name."""
    for each in list(bpy.data.objects):
        bpy.data.objects.remove(each)
    window = bpy.context.window_manager.windows[0]
    with bpy.context.temp_override(window=window, area=view_area()):
        bpy.ops.import_scene.gltf(filepath=SAMPLE)
        bpy.ops.ed.undo_push(message="Import")
    [mesh] = [each for each in bpy.context.scene.objects if each.type == "MESH"]
    return str(mesh.name)


def scene_content(sample: str) -> dict[str, Any]:
    """Return what the scene holds: bricks, layers, and the sample as it was."""
    builds = [each for each in bpy.context.scene.collection.children_recursive if "legorize" in each]
    points = [each for build in builds for each in build.all_objects if each.type == "MESH"]
    mesh = bpy.data.objects[sample].data
    return {
        "builds": len(builds),
        "bricks": sum(len(each.data.vertices) for each in points),
        "layers": sum(len(build.children) for build in builds),
        "objects": len(bpy.context.scene.objects),
        "vertices": len(mesh.vertices),
        "polygons": len(mesh.polygons),
    }


def click_button(seen: dict[str, Any]) -> Wait:
    """Click down the tab's first rows until the operator runs."""
    region = region_of(view_area(), "UI")
    x = region.x + int(region.width * 0.4)
    for below_top in range(30, 120, 8):
        y = region.y + region.height - below_top
        simulate("MOUSEMOVE", "NOTHING", x, y)
        yield 0.2
        simulate("LEFTMOUSE", "PRESS", x, y)
        simulate("LEFTMOUSE", "RELEASE", x, y)
        yield 0.1
        if running():
            seen["button"] = [x, y]
            return
    screenshot("no-button")
    raise AssertionError("no click in the tab started the operator")


def press(key: str, *, ctrl: bool = False) -> Wait:
    """Press a key with the mouse over the 3D viewport."""
    area = view_area()
    x, y = area.x + area.width // 3, area.y + area.height // 2
    simulate("MOUSEMOVE", "NOTHING", x, y)
    yield 0.2
    for value in ("PRESS", "RELEASE"):
        bpy.context.window_manager.windows[0].event_simulate(type=key, value=value, x=x, y=y, ctrl=ctrl)
    yield 0.1


def wait_until(condition: Any) -> Wait:
    """Wait until something holds, and fail when it takes too long."""
    end = time.monotonic() + LIMIT
    while not condition():
        assert time.monotonic() < end, "waited too long"
        yield 0.05


def running() -> bool:
    """Whether the operator waits for its end or for Esc."""
    return any(each.bl_idname == BUTTON for each in bpy.context.window_manager.windows[0].modal_operators)


def view_area() -> Any:
    """Return the 3D viewport."""
    return next(area for area in bpy.context.window_manager.windows[0].screen.areas if area.type == "VIEW_3D")


def region_of(area: Any, kind: str) -> Any:
    """Return a region of an area."""
    return next(region for region in area.regions if region.type == kind)


def frame_all(area: Any) -> None:
    """Bring everything into view."""
    window = bpy.context.window_manager.windows[0]
    with bpy.context.temp_override(window=window, area=area, region=region_of(area, "WINDOW")):
        bpy.ops.view3d.view_all()
    area.tag_redraw()


def simulate(kind: str, value: str, x: int, y: int) -> None:
    """Send an event as mouse and keyboard would; y counts from the bottom."""
    bpy.context.window_manager.windows[0].event_simulate(type=kind, value=value, x=x, y=y)


def screenshot(name: str) -> None:
    """Take a picture of the whole screen, as a person sees it."""
    assert start_screenshot(name).wait(60) == 0


def start_screenshot(name: str) -> subprocess.Popen[bytes]:
    """Begin to take a picture, and return the program that does."""
    return subprocess.Popen(["import", "-window", "root", os.path.join(FOLDER, f"{name}.png")])


def tick(steps: Wait, seen: dict[str, Any]) -> float | None:
    """Do the next step; a timer's failure would only be printed, so it ends Blender here."""
    try:
        return next(steps)
    except StopIteration:
        with open(os.path.join(FOLDER, "seen.json"), "w", encoding="utf-8") as file:
            json.dump(seen, file, indent=1)
        bpy.ops.wm.quit_blender()
        return None
    except BaseException:
        traceback.print_exc()
        sys.stderr.flush()
        os._exit(9)


def main() -> None:
    """Start the steps once the window stands."""
    bpy.context.preferences.view.show_splash = False
    seen: dict[str, Any] = {"version": bpy.app.version_string}
    steps = play(seen)
    bpy.app.timers.register(lambda: tick(steps, seen), first_interval=2.0)


main()
