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
ESTIMATE = 165  # pixels from the top of the tab to its lines
BUTTON_HEIGHT = 40  # pixels, with the gap below it
LIMIT = 300.0  # seconds that any one wait may take

Wait = Iterator[float]  # seconds in which Blender goes on by itself


def play(seen: dict[str, Any]) -> Wait:
    """Do all steps one after another and note what is to be seen after each."""
    sample = import_sample()
    yield from build_undo_cancel(sample, seen)
    yield from copy_and_remove(sample, seen)
    yield from delete_and_show(sample, seen)
    yield from move_and_rebuild(seen)
    yield from edit_bricks(seen)
    yield from open_and_list(seen)


def open_and_list(seen: dict[str, Any]) -> Wait:
    """Open a brick model of somebody else, and choose a row of its table of parts."""
    path = os.path.join(FOLDER, "wall.ldr")
    with open(path, "w", encoding="utf-8") as file:
        for x in range(6):
            file.write(f"1 {4 if x % 2 else 15} {20 * x + 10} -24 10 1 0 0 0 1 0 0 0 1 3005.dat\n")
    bpy.ops.legorize.open_ldraw(filepath=path)
    opened = bpy.context.scene.legorize.build
    opened.legorize_lot = 0
    frame_all(view_area())
    yield 1.0
    seen["opened"] = opened.name
    seen["lots"] = sorted((row.number, row.code, row.count) for row in opened.legorize_lots)
    screenshot("12-row-of-parts")


def build_undo_cancel(sample: str, seen: dict[str, Any]) -> Wait:
    """Build, look, take it back, begin a big model and stop it."""
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
    # the box of hints would move the button
    bpy.ops.legorize.close_hints()
    yield 0.5

    bpy.context.scene.legorize.settings.width = 48
    yield from click_button(seen)
    started = time.monotonic()
    seen["told"] = []
    yield from wait_until(lambda: not listening(seen["told"]))
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
    yield from wait_until(lambda: job().running().seconds_left is not None)
    yield 0.3
    camera = start_screenshot("4-running")  # the work goes on meanwhile
    yield from wait_until(lambda: camera.poll() is not None)
    assert camera.returncode == 0
    assert running()
    yield from press("ESC")
    yield from wait_until(lambda: not running())
    yield 0.5
    seen["cancelled"] = scene_content(sample)
    seen["said"] = bpy.context.window_manager.legorize_said
    screenshot("5-cancelled")


def copy_and_remove(sample: str, seen: dict[str, Any]) -> Wait:
    """Build a small model, duplicate its collection in the outliner, and remove the copy."""
    yield from build_small(seen)
    seen["small"] = scene_content(sample)
    [build] = builds()
    yield from select_in_outliner(build.name)
    in_outliner("collection_duplicate")
    yield 1.0
    seen["copied"] = scene_content(sample)
    [copy] = [each for each in builds() if each != build]
    root = copy["legorize"]["root"]
    root.location.x += 1.5 * max(root.location.length, 1.0)
    frame_all(view_area())
    yield 1.0
    screenshot("6-copied")
    bpy.context.scene.legorize.build = copy
    in_view("clear")
    yield 1.0
    frame_all(view_area())
    yield 1.0
    seen["copy_removed"] = scene_content(sample)
    screenshot("7-copy-removed")


def delete_and_show(sample: str, seen: dict[str, Any]) -> Wait:
    """Delete the model with its hierarchy in the outliner, and click the button that shows its original."""
    [build] = builds()
    seen["hidden"] = bpy.data.objects[sample].hide_viewport
    yield from select_in_outliner(build.name)
    in_outliner("collection_hierarchy_delete")
    yield 1.0
    frame_all(view_area())  # the tab is laid out anew
    yield 1.0
    seen["deleted"] = scene_content(sample)
    screenshot("8-deleted")
    yield from click_until(lambda: not bpy.data.objects[sample].hide_viewport, seen["button"][1] - BUTTON_HEIGHT)
    yield 1.0
    seen["shown_again"] = scene_content(sample)
    seen["selected"] = [each.name for each in bpy.context.view_layer.objects if each.select_get()]
    screenshot("9-shown-again")


def move_and_rebuild(seen: dict[str, Any]) -> Wait:
    """Build, move the model with a key and the mouse, turn the heat map on, and click the button again."""
    yield from build_small(seen)
    [build] = builds()
    seen["unmoved"] = list(build["legorize"]["root"].location)
    yield from press("G")
    area = view_area()
    x, y = area.x + area.width // 2, area.y + area.height // 2
    simulate("MOUSEMOVE", "NOTHING", x, y)
    yield 0.3
    simulate("LEFTMOUSE", "PRESS", x, y)
    simulate("LEFTMOUSE", "RELEASE", x, y)
    yield 0.5
    bpy.context.scene.legorize.heat_map = True
    frame_all(view_area())
    yield 1.0
    seen["moved"] = list(build["legorize"]["root"].location)
    screenshot("10-moved")
    with bpy.context.temp_override(window=window(), area=area, region=region_of(area, "WINDOW")):
        bpy.ops.view3d.view_axis(type="FRONT")
    yield 0.5
    view = area.spaces.active.region_3d
    near = view.view_distance
    view.view_distance = 20 * near
    yield 0.5
    yield from press("NUMPAD_PERIOD")
    yield from wait_until(lambda: view.view_distance < 10 * near)
    # a view turns to its place in several steps, and a busy machine draws the last one late
    yield 1.0
    with bpy.context.temp_override(window=window(), area=area, region=region_of(area, "WINDOW")):
        bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=1)
    extent = build["legorize"]["extent"]
    high = build["legorize"]["root"].matrix_world.median_scale * (extent["high"][2] - extent["low"][2])
    seen["framed"] = {"height": high, "distance": view.view_distance, "looked_at": list(view.view_location)}
    screenshot("10-view-selected")
    yield from click_button(seen)
    yield from wait_until(lambda: not running())
    yield 1.0
    [build] = builds()
    seen["rebuilt"] = list(build["legorize"]["root"].location)
    seen["heat_map"] = bpy.context.scene.legorize.heat_map
    screenshot("11-rebuilt")


def edit_bricks(seen: dict[str, Any]) -> Wait:
    """Choose the tool, pick bricks by clicks, recolour and lock them in the menu, take the last one back by a key."""
    bpy.context.scene.legorize.heat_map = False
    area = view_area()
    with bpy.context.temp_override(window=window(), area=area, region=region_of(area, "WINDOW")):
        bpy.ops.wm.tool_set_by_id(name="legorize.edit_bricks")
    frame_all(area)
    yield 1.0
    found: list[tuple[int, int]] = []
    for x, y in around_the_middle(area):
        yield from click("LEFTMOUSE", x, y)
        if picked():
            found.append((x, y))
            break
    seen["picked"] = [len(picked())]
    first = picked()
    for x, y in around_the_middle(area):
        yield from click("LEFTMOUSE", x, y, shift=True)
        if len(picked()) == 2:
            break
        if picked() != first:
            # the same brick once more takes it out again
            yield from click("LEFTMOUSE", *found[0], shift=True)
    seen["picked"].append(len(picked()))
    screenshot("13-picked")
    x, y = found[0]
    yield from click("RIGHTMOUSE", x, y)
    yield 0.7
    screenshot("14-menu")
    yield from key("L", x, y)
    yield 1.0
    seen["locked"] = listed()
    yield from click("LEFTMOUSE", x, y)
    yield from click("RIGHTMOUSE", x, y)
    yield 0.7
    yield from key("R", x, y)
    yield 0.7
    screenshot("15-colours")
    for away in range(24, 120, 12):
        yield from click("LEFTMOUSE", x - 60, y - away)
        if len(listed()) > len(seen["locked"]):
            break
    yield 1.0
    seen["recoloured"] = listed()
    screenshot("16-recoloured")
    yield from press("Z", ctrl=True)
    yield 1.0
    seen["edit_undone"] = listed()
    yield from click_button(seen)
    yield from wait_until(lambda: not running())
    yield 1.0
    seen["edits_rebuilt"] = listed()
    screenshot("17-rebuilt-with-edits")


def around_the_middle(area: Any) -> Iterator[tuple[int, int]]:
    """Yield places in a 3D viewport, its middle first."""
    region = region_of(area, "WINDOW")
    for away in range(0, 240, 24):
        for dx, dy in ((0, 0), (away, 0), (-away, 0), (0, away), (0, -away)):
            yield region.x + region.width // 2 - 100 + dx, region.y + region.height // 2 + dy


def click(button: str, x: int, y: int, *, shift: bool = False) -> Wait:
    """Click at a place of the window."""
    simulate("MOUSEMOVE", "NOTHING", x, y)
    yield 0.2
    for value in ("PRESS", "RELEASE"):
        window().event_simulate(type=button, value=value, x=x, y=y, shift=shift)
        yield 0.1


def key(name: str, x: int, y: int) -> Wait:
    """Press a key with the mouse at a place."""
    for value in ("PRESS", "RELEASE"):
        window().event_simulate(type=name, value=value, x=x, y=y)
        yield 0.1


def picked() -> list[int]:
    """Return the rows of the picked bricks."""
    return list(builds()[-1]["legorize"].get("picked", ()))


def listed() -> list[list[str]]:
    """Return the kind of each change by hand, and why it does not fit."""
    return [[row.kind, row.reason] for row in builds()[-1].legorize_edits]


def build_small(seen: dict[str, Any]) -> Wait:
    """Click the button for a small model and wait for it."""
    bpy.context.scene.legorize.settings.width = 12
    yield from click_button(seen)
    yield from wait_until(lambda: not running())
    yield 1.0


def builds() -> list[Any]:
    """Return the collections that say of themselves that they are models."""
    return [each for each in bpy.context.scene.collection.children_recursive if "legorize" in each]


def listening(told: list[Any]) -> bool:
    """Note how far the job says that it is; return whether it goes on."""
    at_work = job().running()
    if at_work:
        told.append([*at_work.progress, at_work.seconds_left])
    return running()


def job() -> Any:
    """Return the add-on's module that knows of the work in its thread."""
    from bl_ext.user_default.legorize.legorize_addon.ui import job

    return job


def select_in_outliner(name: str) -> Wait:
    """Click down the rows of the outliner until a collection of a name is selected."""
    area = area_of("OUTLINER")
    region = region_of(area, "WINDOW")
    x = region.x + 120
    for below_top in range(8, region.height, 10):
        y = region.y + region.height - below_top
        simulate("MOUSEMOVE", "NOTHING", x, y)
        yield 0.1
        simulate("LEFTMOUSE", "PRESS", x, y)
        simulate("LEFTMOUSE", "RELEASE", x, y)
        yield 0.2
        with bpy.context.temp_override(window=window(), area=area, region=region):
            chosen = [each for each in bpy.context.selected_ids if isinstance(each, bpy.types.Collection)]
        if [each.name for each in chosen] == [name]:
            return
    screenshot("not-in-outliner")
    raise AssertionError(f"no row of the outliner selects {name}")


def click_until(condition: Any, top: int) -> Wait:
    """Click down the tab's rows from a height on until something holds."""
    region = region_of(view_area(), "UI")
    x = region.x + int(region.width * 0.4)
    for y in range(top, region.y, -8):
        simulate("MOUSEMOVE", "NOTHING", x, y)
        yield 0.2
        simulate("LEFTMOUSE", "PRESS", x, y)
        simulate("LEFTMOUSE", "RELEASE", x, y)
        yield 0.4
        if condition():
            return
    screenshot("no-click")
    raise AssertionError("no click in the tab did it")


def in_outliner(operator: str) -> None:
    """Choose an entry of the menu on the selected row of the outliner."""
    area = area_of("OUTLINER")
    with bpy.context.temp_override(window=window(), area=area, region=region_of(area, "WINDOW")):
        getattr(bpy.ops.outliner, operator)("INVOKE_DEFAULT", True)


def in_view(operator: str) -> None:
    """Use one of our operators in the 3D viewport."""
    with bpy.context.temp_override(window=window(), area=view_area(), region=region_of(view_area(), "WINDOW")):
        getattr(bpy.ops.legorize, operator)("INVOKE_DEFAULT", True)


def import_sample() -> str:
    """Empty the scene, import the sample, select it, and return its name."""
    for each in list(bpy.data.objects):
        bpy.data.objects.remove(each)
    with bpy.context.temp_override(window=window(), area=view_area()):
        bpy.ops.import_scene.gltf(filepath=SAMPLE)
        bpy.ops.ed.undo_push(message="Import")
    [mesh] = [each for each in bpy.context.scene.objects if each.type == "MESH"]
    return str(mesh.name)


def scene_content(sample: str) -> dict[str, Any]:
    """Return what the scene holds: bricks, layers, and the sample as it was."""
    points = [each for build in builds() for each in build.all_objects if each.modifiers]
    mesh = bpy.data.objects[sample].data
    return {
        "builds": len(builds()),
        "bricks": sum(len(each.data.vertices) for each in points),
        "layers": sum(len(build.children) for build in builds()),
        "objects": len(bpy.context.scene.objects),
        "vertices": len(mesh.vertices),
        "polygons": len(mesh.polygons),
        "instances": n_instances(),
    }


def n_instances() -> int:
    """Return how many bricks the viewport shows."""
    return sum(each.is_instance for each in bpy.context.evaluated_depsgraph_get().object_instances)


def click_button(seen: dict[str, Any]) -> Wait:
    """Click down from the lines of the estimate, where a click does nothing, until the operator runs."""
    region = region_of(view_area(), "UI")
    x = region.x + int(region.width * 0.4)
    for below_top in range(ESTIMATE, ESTIMATE + 140, 8):
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
        window().event_simulate(type=key, value=value, x=x, y=y, ctrl=ctrl)
    yield 0.1


def wait_until(condition: Any) -> Wait:
    """Wait until something holds, and fail when it takes too long."""
    end = time.monotonic() + LIMIT
    while not condition():
        assert time.monotonic() < end, "waited too long"
        yield 0.05


def running() -> bool:
    """Whether the operator waits for its end or for Esc."""
    return any(each.bl_idname == BUTTON for each in window().modal_operators)


def view_area() -> Any:
    """Return the 3D viewport."""
    return area_of("VIEW_3D")


def area_of(kind: str) -> Any:
    """Return an area of the window."""
    return next(area for area in window().screen.areas if area.type == kind)


def window() -> Any:
    """Return the window."""
    return bpy.context.window_manager.windows[0]


def region_of(area: Any, kind: str) -> Any:
    """Return a region of an area."""
    return next(region for region in area.regions if region.type == kind)


def frame_all(area: Any) -> None:
    """Bring everything into view."""
    with bpy.context.temp_override(window=window(), area=area, region=region_of(area, "WINDOW")):
        bpy.ops.view3d.view_all()
    area.tag_redraw()


def simulate(kind: str, value: str, x: int, y: int) -> None:
    """Send an event as mouse and keyboard would; y counts from the bottom."""
    window().event_simulate(type=kind, value=value, x=x, y=y)


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
    except BaseException:  # noqa: BLE001 - shown, and the window ends
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
