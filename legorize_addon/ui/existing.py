"""Brick models that exist already: opened from LDraw files, or laid again."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt
from bpy.app.translations import pgettext_tip as tip
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from ..core.errors import BuildError
from ..core.model import load_catalogue
from ..core.progress import Progress
from ..core.units import MM_PER_METRE
from ..scene import Source, read_bricks, sources_of, state_of
from ..view import show_result
from . import counts, job
from .current import current_build
from .edits import list_edits
from .export import chosen_path, title_of
from .kept_texts import with_texts
from .learned_files import resolved
from .parts import list_parts_of
from .requests import absolute_files, by_uid
from .settings_properties import settings_of
from .working import BUSY, Browsing, OnBuild, Working, select_only

if TYPE_CHECKING:
    from ..core.build import Judged
    from ..core.existing import Existing, StepsFrom
    from ..core.settings import Settings

STEPS_ITEMS: Final = [
    ("file", "As in the File", "Keep the building steps of the author, if there are any"),
    ("new", "New", "Plan new building steps, with temporary supports"),
]


@dataclass(frozen=True, slots=True, eq=False)
class ExistingRequest:
    """A brick model to judge or to lay again.

    Attributes
    ----------
    name : str
        Of the model.
    scene : int
        Session identifier of the scene that gets it.
    given : Existing
    settings : Settings
    samples : str
        Path of the training file that the settings name.
    files : mapping of str to str
        Absolute paths of the other files that settings name, by the setting.
    again : bool
        Whether it is laid again.
    steps : str
        Whose building steps count.
    scale : float
        Model mm per world mm.
    origin : tuple of three float
        Corner of its grid in model mm.
    mm_per_unit : float
        World mm per Blender unit.
    sources : tuple of int
        Session identifiers of the objects that it was made of.
    replaces : tuple of int
        Session identifiers of the builds whose place it takes.
    """

    name: str
    scene: int
    given: Existing
    settings: Settings
    samples: str
    files: Mapping[str, Any]
    again: bool
    steps: StepsFrom
    scale: float
    origin: tuple[float, float, float]
    mm_per_unit: float
    sources: tuple[int, ...] = ()
    replaces: tuple[int, ...] = ()

    def work(self, progress: Progress) -> Judged:
        """Run the core; no Blender in here."""
        from ..core.pipeline import judge

        settings = replace(self.settings, learned_from=self.samples, **self.files)
        made = judge(self.given, settings, again=self.again, steps=self.steps, scale=self.scale, progress=progress)
        made = replace(made, settings=self.settings, corner=np.array(self.origin))
        return with_texts(made, title=self.name, remarks=(), mm_per_unit=self.mm_per_unit)


class Judging(Working):
    """What comes of a brick model is shown as a build."""

    def _show(self, context: bpy.types.Context, order: ExistingRequest, made: Judged) -> set[str]:
        [scene] = by_uid(bpy.data.scenes, [order.scene]) or [None]
        if scene is None:
            raise BuildError("The scene was deleted meanwhile: open another one and start again.")
        source = Source(order.name, by_uid(bpy.data.objects, order.sources), notes=made.notes)
        shown = show_result(
            scene,
            made,
            source,
            mm_per_unit=order.mm_per_unit,
            detail=scene.legorize.detail,
            replaces=by_uid(bpy.data.collections, order.replaces),
        )
        list_parts_of(shown, made)
        list_edits(shown)
        scene.legorize.build = shown
        if scene == context.scene:
            select_only(context, state_of(shown).root)
        self.report({"INFO"}, rpt("Model built: {}.").format(counts.bricks(len(made.bricks))))
        for note in made.notes:
            self.report({"WARNING"}, note)
        return {"FINISHED"}


class LEGORIZE_OT_open_ldraw(Browsing, Judging, bpy.types.Operator):
    """Open an LDraw file as a brick model."""

    bl_idname = "legorize.open_ldraw"
    bl_label = "Open LDraw Model"
    bl_description = (
        "Read a brick model of any program (.ldr, .mpd) and judge it as one of our own: stability, building steps, "
        "lists of parts, booklet"
    )
    bl_options = {"REGISTER", "UNDO"}
    _timer = None
    kept = ("filepath", "again", "steps", "magnified")

    filepath: StringProperty(subtype="FILE_PATH")
    filter_glob: StringProperty(default="*.ldr;*.mpd", options={"HIDDEN"})
    chosen: BoolProperty(options={"HIDDEN", "SKIP_SAVE"})
    again: BoolProperty(
        name="Lay Again", description="Lay the same cells and colours again, in fewer bricks", default=False
    )
    steps: EnumProperty(name="Steps", description="Whose building steps count", items=STEPS_ITEMS)
    magnified: FloatProperty(
        name="Size", description="How many times larger than the real bricks the model is in the scene", default=10.0,
        min=0.01, max=1000.0,
    )  # fmt: skip

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether nothing else is at work."""
        cls.poll_message_set(tip(BUSY))
        return not job.running()

    def _take_order(self, context: bpy.types.Context) -> ExistingRequest:
        from ..core.existing import Existing
        from ..core.files import named
        from ..core.ldraw import SUFFIXES, read_file

        path = Path(named(str(chosen_path(self)), "file", BuildError))
        if path.suffix.lower() not in SUFFIXES:
            raise BuildError(f"{path.name} is no LDraw file: choose one that ends in {' or '.join(SUFFIXES)}.")
        found = read_file(path, load_catalogue())
        settings = settings_of(context.scene.legorize.settings)
        return ExistingRequest(
            name=path.stem,
            scene=context.scene.session_uid,
            given=Existing.of(found),
            settings=settings,
            samples=resolved(settings.learned_from),
            files=absolute_files(settings),
            again=self.again,
            steps=self.steps,
            scale=1 / self.magnified,
            origin=(0.0, 0.0, 0.0),
            mm_per_unit=context.scene.unit_settings.scale_length * MM_PER_METRE,
        )


class LEGORIZE_OT_again(OnBuild, Judging, bpy.types.Operator):
    """Lay the bricks of the build that the panel shows again."""

    bl_idname = "legorize.again"
    bl_label = "Legorize Again"
    bl_description = (
        "Lay the same cells again, in fewer bricks that show the same colours; without a better layout the model stays "
        "as it is"
    )
    bl_options = {"REGISTER", "UNDO"}
    _timer = None

    def _take_order(self, context: bpy.types.Context) -> ExistingRequest:
        return order_of(context, again=True)


def order_of(context: bpy.types.Context, *, again: bool) -> ExistingRequest:
    """Return the request to lay the bricks of the build that the panel shows again, or to plan their steps."""
    from ..core.existing import Existing

    build = current_build(context.scene)
    state, settings = state_of(build), settings_of(context.scene.legorize.settings)
    mm_per_unit = context.scene.unit_settings.scale_length * MM_PER_METRE
    return ExistingRequest(
        name=title_of(build),
        scene=context.scene.session_uid,
        given=Existing(read_bricks(build)),
        settings=settings,
        samples=resolved(settings.learned_from),
        files=absolute_files(settings),
        again=again,
        steps="new",
        scale=1 / (state.unit_per_mm * mm_per_unit),
        origin=state.origin,
        mm_per_unit=mm_per_unit,
        sources=tuple(source.session_uid for source in sources_of(build)),
        replaces=(build.session_uid,),
    )


class LEGORIZE_OT_plan_steps(OnBuild, Judging, bpy.types.Operator):
    """Plan supports and building steps of the bricks as they are."""

    bl_idname = "legorize.plan_steps"
    bl_label = "Plan Steps"
    bl_description = "Plan supports and building steps of the bricks as they are now, and test whether they stand"
    bl_options = {"REGISTER", "UNDO"}
    _timer = None

    def _take_order(self, context: bpy.types.Context) -> ExistingRequest:
        return order_of(context, again=False)


classes = (LEGORIZE_OT_open_ldraw, LEGORIZE_OT_again, LEGORIZE_OT_plan_steps)
register, unregister = bpy.utils.register_classes_factory(classes)
