"""The steps of the method: buttons that show them in the scene or write them, and their panel."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

import bpy
import numpy as np
from bpy.app.translations import pgettext_iface as iface
from bpy.app.translations import pgettext_n as n
from bpy.app.translations import pgettext_rpt as rpt
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ..core.errors import BuildError
from ..core.model import Assembly, Role, load_catalogue
from ..core.progress import Progress, part
from ..scene import builds_of, damage, read_bricks, state_of
from ..view import STEPS, MethodView, has_trajectories, show_method
from . import counts, job
from .current import current_build
from .export import chosen_path, proposed_path
from .live import leave_preview
from .requests import BuildRequest, build_request, by_uid, chosen_sources
from .settings_properties import settings_of
from .view_choices import LINE_ITEMS
from .working import Browsing, Working

if TYPE_CHECKING:
    from ..core.build import Draft
    from ..core.method import Shown
    from ..core.model import Bricks

STEP_ITEMS: Final = [(step, name, text) for step, (name, text) in STEPS.items()]


@dataclass(frozen=True, slots=True, eq=False)
class DraftRequest:
    """A model to go as far with as there is no brick yet.

    Attributes
    ----------
    request : BuildRequest
        Objects and settings.
    """

    request: BuildRequest

    def work(self, progress: Progress) -> Draft:
        """Run the core; no Blender in here."""
        from ..core.drafting import draft_model

        settings = replace(self.request.settings, learned_from=self.request.samples, **self.request.files)
        return draft_model(self.request.mesh, settings, progress)


@dataclass(frozen=True, slots=True, eq=False)
class FilesRequest:
    """Files of the method to write.

    Attributes
    ----------
    drafted : DraftRequest
    models : tuple of (Bricks, (float, float, float))
        Models that were built of the same objects, each with the corner of its grid in model mm.
    lines : str
        How trajectories are coloured.
    folder : pathlib.Path
        For the files.
    """

    drafted: DraftRequest
    models: tuple[tuple[Bricks, tuple[float, float, float]], ...]
    lines: Shown
    folder: Path

    def work(self, progress: Progress) -> tuple[Path, ...]:
        """Write all files, or none; no Blender in here."""
        from ..core.files import new_folder
        from ..core.method import method_files

        draft = self.drafted.work(part(progress, 0.0, 0.9))
        title = self.drafted.request.name
        texts = method_files(
            draft, self.supports(draft), title=title, shown=self.lines, catalogue=load_catalogue(),
            progress=part(progress, 0.9, 1.0),
        )  # fmt: skip
        with new_folder(self.folder) as fresh:
            for name, text in texts:
                (fresh / name).parent.mkdir(exist_ok=True)
                (fresh / name).write_text(text, encoding="utf-8", newline="")
        return (self.folder,)

    def supports(self, draft: Draft) -> Assembly | None:
        """Return the supports of the model that stands on the same grid as a draft; None without one."""
        for bricks, origin in self.models:
            if np.allclose(origin, draft.grid.origin, atol=1e-3):
                return Assembly(bricks.take(bricks.role == Role.SUPPORT_OUTSIDE), load_catalogue())
        return None


def _drafted(context: bpy.types.Context) -> DraftRequest:
    """Read the chosen objects."""
    settings = settings_of(context.scene.legorize.settings)
    request = build_request(context, chosen_sources(context), settings)
    # also one that is still being made
    leave_preview(context)
    return DraftRequest(request)


class LEGORIZE_OT_show_method(Working, bpy.types.Operator):
    """Show a step of the method beside the model."""

    bl_idname = "legorize.show_method"
    bl_label = "Show Step of the Method"
    bl_description = (
        "Show trajectories, unit bricks or hollowing of the selected objects as a model of its own beside them; the "
        "panel Layers shows it layer by layer"
    )
    bl_options = {"REGISTER", "UNDO"}
    nothing_chosen = n("Select an object with a surface.")

    step: EnumProperty(name="Step", description="What to show", items=STEP_ITEMS)
    lines: EnumProperty(name="Trajectories", description="Colours of the trajectories", items=LINE_ITEMS)

    def _take_order(self, context: bpy.types.Context) -> DraftRequest:
        return _drafted(context)

    def _show(self, context: bpy.types.Context, order: DraftRequest, draft: Draft) -> set[str]:
        request = order.request
        [scene] = by_uid(bpy.data.scenes, [request.scene]) or [None]
        if scene is None:
            raise BuildError("The scene was deleted meanwhile: open another one and start again.")
        scene.legorize.build = show_method(
            scene, draft, request.name, view=MethodView(self.step, self.lines), mm_per_unit=request.mm_per_unit,
            detail=scene.legorize.detail,
        )  # fmt: skip
        self.report(
            {"INFO"},
            rpt("{} of {}: {}.").format(
                iface(STEPS[self.step][0]), request.name, counts.slices(len(draft.cut.slices.heights))
            ),
        )
        return {"FINISHED"}


class LEGORIZE_OT_write_method(Browsing, bpy.types.Operator):
    """Write the files that show the method."""

    bl_idname = "legorize.write_method"
    bl_label = "Write Method"
    bl_description = (
        "Write trajectories and hollowing as a map of each layer, the tree of the trajectories, and models of unit "
        "bricks (.ldr), into a folder"
    )
    bl_options = {"REGISTER"}
    nothing_chosen = n("Select an object with a surface.")
    _timer = None
    kept = ("filepath", "lines")

    filepath: StringProperty(subtype="FILE_PATH")
    chosen: BoolProperty(options={"HIDDEN", "SKIP_SAVE"})
    lines: EnumProperty(name="Trajectories", description="Colours of the trajectories", items=LINE_ITEMS)

    def propose(self, context: bpy.types.Context) -> None:
        """Name the folder like the objects, beside the scene's own file."""
        names = " + ".join(source.name for source in chosen_sources(context))
        self.filepath = proposed_path(names, " method")

    def _take_order(self, context: bpy.types.Context) -> FilesRequest:
        drafted = _drafted(context)
        return FilesRequest(drafted, _models(context), self.lines, chosen_path(self))

    def _show(self, context: bpy.types.Context, order: FilesRequest, paths: tuple[Path, ...]) -> set[str]:
        self.report({"INFO"}, rpt("Wrote {}.").format(", ".join(map(str, paths))))
        return {"FINISHED"}


def _models(context: bpy.types.Context) -> tuple[tuple[Bricks, tuple[float, float, float]], ...]:
    """Return the bricks and the corner of the grid of each model that was built of the chosen objects."""
    found = [model for model in builds_of(context.scene, chosen_sources(context)) if damage(model) is None]
    return tuple((read_bricks(model), state_of(model).origin) for model in found)


class LEGORIZE_PT_method(bpy.types.Panel):
    """What the steps before the layout look like."""

    bl_label = "Steps of the Method"
    bl_parent_id = "LEGORIZE_PT_main"
    bl_options = {"DEFAULT_CLOSED"}
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Legorize"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw a button for each step, one for the files, and the switch of the trajectories."""
        self.layout.enabled = job.running() is None
        view = context.scene.legorize
        self.layout.row().prop(view, "lines", expand=True)
        column = self.layout.column(align=True)
        for step, (name, _) in STEPS.items():
            button = column.operator(LEGORIZE_OT_show_method.bl_idname, text=name)
            button.step, button.lines = step, view.lines
        self.layout.operator(LEGORIZE_OT_write_method.bl_idname, icon="EXPORT").lines = view.lines
        build = current_build(context.scene)
        if build and has_trajectories(build):
            self.layout.prop(view, "trajectories")


classes = (LEGORIZE_OT_show_method, LEGORIZE_OT_write_method, LEGORIZE_PT_method)
register, unregister = bpy.utils.register_classes_factory(classes)
