"""The buttons that write files: LDraw and pictures."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

import bpy
from bpy.app.translations import pgettext_rpt as rpt
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from ..core.errors import BuildError
from ..core.model import Assembly, Role, load_catalogue
from ..render import AZIMUTH, render_still
from ..scene import hand_remark, n_deleted, read_bricks
from .current import current_build
from .settings_properties import label
from .working import OnBuild

_NO_NAME: Final = re.compile(r'[\x00-\x1f<>:"/\\|?*]')
"""Characters that names of files cannot have in Windows, with those that they cannot have elsewhere."""

VIEWS: Final = [*((view, label(view), "") for view in AZIMUTH), ("section", "Section", "Onto the cut")]


def written(path: Path, build: bpy.types.Collection) -> tuple[set[str], str]:
    """Return what to report of a file with the bricks of a build: a warning if some were deleted or moved."""
    gone, remark = n_deleted(build), hand_remark(build)
    if remark:
        return {"WARNING"}, f"Wrote {path}. {remark}"
    if not gone:
        return {"INFO"}, rpt("Wrote {}.").format(path)
    one = rpt("Wrote {} without the bricks of 1 object that was deleted: build the model again for all of them.")
    more = rpt("Wrote {} without the bricks of {} objects that were deleted: build the model again for all of them.")
    return {"WARNING"}, (one if gone == 1 else more).format(path, gone)


class Exporting(OnBuild, ExportHelper):
    """What writes one file of the build that the panel shows."""

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Ask for the file; its name is proposed."""
        self.filepath = proposed_path(title_of(current_build(context.scene)), self.filename_ext)
        return ExportHelper.invoke(self, context, event)


class LEGORIZE_OT_export_ldr(Exporting, bpy.types.Operator):
    """Write the build that the panel shows as an LDraw file."""

    bl_idname = "legorize.export_ldr"
    bl_label = "Export LDraw"
    bl_description = (
        "Write the finished model as an LDraw file, which LeoCAD, BrickLink Studio and other programs open; supports "
        "that are taken out again are left out"
    )
    bl_options = {"REGISTER"}
    of_steps = True
    filename_ext = ".ldr"
    filter_glob: StringProperty(default="*.ldr", options={"HIDDEN"})

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Write the file."""
        return self.reported(self._write, current_build(context.scene))

    def _write(self, build: bpy.types.Collection) -> set[str]:
        from ..core.files import write_ldr, write_whole

        path, bricks = chosen_path(self), read_bricks(build)
        finished = bricks.take(bricks.role != Role.SUPPORT_OUTSIDE)
        write_whole(path, write_ldr(Assembly(finished, load_catalogue()), name=path.name, title=build.name))
        self.report(*written(path, build))
        return {"FINISHED"}


class LEGORIZE_OT_export_mpd(Exporting, bpy.types.Operator):
    """Write the build that the panel shows, with its pieces and supports, as an LDraw multi-part document."""

    bl_idname = "legorize.export_mpd"
    bl_label = "Export LDraw with Supports"
    bl_description = (
        "Write the model, its pieces and its supports as sub-models of one LDraw document, in building order"
    )
    bl_options = {"REGISTER"}
    filename_ext = ".mpd"
    filter_glob: StringProperty(default="*.mpd", options={"HIDDEN"})

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Write the file."""
        return self.reported(self._write, current_build(context.scene))

    def _write(self, build: bpy.types.Collection) -> set[str]:
        from ..core.building import steps_of
        from ..core.files import write_mpd, write_whole

        path, assembly = chosen_path(self), Assembly(read_bricks(build), load_catalogue())
        name, steps = path.with_suffix(".ldr").name, steps_of(assembly)
        write_whole(path, write_mpd(assembly, steps, name=name, title=build.name))
        self.report(*written(path, build))
        return {"FINISHED"}


class LEGORIZE_OT_render_still(Exporting, bpy.types.Operator):
    """Render the scene's builds to a file."""

    bl_idname = "legorize.render_still"
    bl_label = "Render Picture"
    bl_description = "Render the brick model with its own light and ground; Blender waits until it is done"
    bl_options = {"REGISTER"}
    of_steps = True
    filename_ext = ".png"
    filter_glob: StringProperty(default="*.png", options={"HIDDEN"})
    samples: IntProperty(
        name="Samples", description="Light paths per pixel; more is cleaner and slower", default=24, min=1
    )
    width: IntProperty(name="Width", description="Width of the picture in pixels", default=1280, min=16, max=16384)
    height: IntProperty(name="Height", description="Height of the picture in pixels", default=960, min=16, max=16384)
    view: EnumProperty(
        name="View",
        description="Corner from which the model is seen, or the side where it is cut open",
        items=VIEWS,
        default="front_right",
    )
    outlines: BoolProperty(name="Outlines", description="Draw dark lines around the bricks", default=False)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Render and write the file."""
        return self.reported(self._render, context.scene)

    def _render(self, scene: bpy.types.Scene) -> set[str]:
        path = chosen_path(self)
        size = self.width, self.height
        render_still(scene, path, samples=self.samples, resolution=size, view=self.view, outlines=self.outlines)
        self.report({"INFO"}, rpt("Wrote {}.").format(path))
        return {"FINISHED"}


def chosen_path(operator: bpy.types.Operator) -> Path:
    """Return the path that an operator is to write to; ``//`` at its beginning is the folder of the .blend file.

    Raises
    ------
    BuildError
        It is none.
    """
    from ..core.files import named

    return named(bpy.path.abspath(operator.filepath), "file", BuildError)


def title_of(build: bpy.types.Collection) -> str:
    """Return the name of a model, which is that of its source."""
    return build.name.removeprefix("Legorize ")


def proposed_path(title: str, suffix: str) -> str:
    """Return the path of a file that is named like a model, beside the scene's own."""
    # objects may be called what no file can be: a slash would be a folder
    name = f"{_NO_NAME.sub('_', title)}{suffix}"
    return str(Path(bpy.data.filepath).with_name(name)) if bpy.data.filepath else name


classes = (LEGORIZE_OT_export_ldr, LEGORIZE_OT_export_mpd, LEGORIZE_OT_render_still)
register, unregister = bpy.utils.register_classes_factory(classes)
