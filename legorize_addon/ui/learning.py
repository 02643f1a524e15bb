"""Learning from the user's own models: more training samples for the fast layout, in the user's own folder."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any, Final

import bpy
import numpy as np
from bpy.app.translations import pgettext_n as n
from bpy.app.translations import pgettext_rpt as rpt

from ..core.model import Bricks, UnitGrid, load_catalogue
from ..core.progress import Progress, part
from ..core.settings import Settings
from ..scene import builds_of, is_own, sources_of, state_of
from .learned_files import new_file, own_versions, resolved
from .reporting import Reporting
from .requests import build_request, chosen_sources
from .settings_properties import settings_of
from .working import Working

if TYPE_CHECKING:
    from ..core.mesh import TriangleMesh

_LAYING: Final = 0.9
"""Share of the time that laying the models takes, of laying and learning."""


@dataclass(frozen=True, slots=True, eq=False)
class Lesson:
    """A model to learn from.

    Attributes
    ----------
    name : str
        What it was made of.
    mesh : TriangleMesh
        Its surface.
    settings : Settings
        How it is built; only its bricks are laid quickly and as if nothing had been learned.
    """

    name: str
    mesh: TriangleMesh
    settings: Settings

    def laid(self, progress: Progress) -> tuple[UnitGrid, Bricks]:
        """Return the hollowed model and its bricks."""
        from ..core.pipeline import legorize

        quick = replace(self.settings, layout="fast", learned=False, learned_from="", supports="none", split=1)
        quick = replace(quick, goal="fewest", prices="", owned="", mass_weight=0.0, few_lots=0.0)
        build = legorize(self.mesh, quick, progress)
        return build.hollow, build.bricks


@dataclass(frozen=True, slots=True, eq=False)
class Lessons:
    """What is learned at once.

    Attributes
    ----------
    models : tuple of Lesson
        Models to take samples from.
    text : str
        The samples so far.
    version : int
        Of the file to write.
    seed : int
        Draws the samples.
    of_fill : bool
        Whether the machine of the learned layout learns, or that of the fast one.
    """

    models: tuple[Lesson, ...]
    text: str
    version: int
    seed: int
    of_fill: bool

    def work(self, progress: Progress) -> str:
        """Return the text of the next version; no Blender in here."""
        from ..core.layout.learning import learn_more, learn_more_grades

        turns, n = enumerate(self.models), len(self.models)
        laid = [model.laid(part(progress, _LAYING * turn / n, _LAYING * (turn + 1) / n)) for turn, model in turns]
        progress("learning", _LAYING)
        rng = np.random.default_rng(self.seed)
        named = {"names": [model.name for model in self.models], "version": self.version}
        if self.of_fill:
            return learn_more_grades(self.text, [grid for grid, _ in laid], load_catalogue(), rng, **named)
        return learn_more(self.text, laid, load_catalogue(), rng, **named)


class LEGORIZE_OT_learn(Working, bpy.types.Operator):
    """Teach the machine of the learned layout, or that of the fast one, by the chosen models."""

    bl_idname = "legorize.learn"
    bl_label = "Learn from Models"
    bl_description = (
        "Learn from the selected brick models or objects which bricks are good ones, for the learned layout if that is "
        "chosen, or which exchanges of bricks save parts, for the fast one; the earlier training is kept as a file"
    )
    bl_options = {"REGISTER", "UNDO"}

    nothing_chosen = n("Select brick models, or objects with a surface.")

    def _take_order(self, context: bpy.types.Context) -> Lessons:
        from ..core.layout.learning import grades_text, grades_version, samples_text, version_of

        settings = settings_of(context.scene.legorize.settings)
        of_fill, path = settings.layout == "learned", resolved(settings.learned_from)
        text = grades_text(path) if of_fill else samples_text(path)
        version = max(grades_version(text) if of_fill else version_of(text), *own_versions()) + 1
        return Lessons(tuple(_lessons(context, settings)), text, version, settings.seed, of_fill)

    def _show(self, context: bpy.types.Context, order: Lessons, text: str) -> set[str]:
        from ..core.files import write_whole
        from ..core.layout.learning import read, read_graded

        path, name = new_file(order.version)
        write_whole(path, text)
        context.scene.legorize.settings.learned_from = name
        samples, facts = read_graded(text) if order.of_fill else read(text)
        told = rpt("Learned version {} from {} samples, {} models more than before ({}): {}.")
        counts = order.version, len(samples.model), len(order.models)
        self.report({"INFO"}, told.format(*counts, facts["cross-validation"], path))
        return {"FINISHED"}


class LEGORIZE_OT_forget(Reporting, bpy.types.Operator):
    """Go back to the samples that are shipped."""

    bl_idname = "legorize.forget"
    bl_label = "Reset to Built-in Training"
    bl_description = "Use the built-in training again; your training files are kept"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether something else is used."""
        return bool(context.scene.legorize.settings.learned_from)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Clear the name of the file."""
        context.scene.legorize.settings.learned_from = ""
        return {"FINISHED"}


def _lessons(context: bpy.types.Context, settings: Settings) -> Iterator[Lesson]:
    """Yield a lesson for each brick model that is selected, and one for all other objects together."""
    models = builds_of(context.scene, [thing for thing in context.selected_objects if is_own(thing)])
    for model in models:
        yield _lesson(context, sources_of(model), _known(state_of(model).settings))
    of_models = {source for model in models for source in sources_of(model)}
    others = [source for source in chosen_sources(context) if source not in of_models]
    if others:
        yield _lesson(context, others, settings)


def _known(stored: dict[str, Any]) -> Settings:
    """Return the settings of a build; those that its version did not know are as they are by default."""
    return Settings(**{entry.name: stored[entry.name] for entry in fields(Settings) if entry.name in stored})


def _lesson(context: bpy.types.Context, sources: Sequence[bpy.types.Object], settings: Settings) -> Lesson:
    order = build_request(context, sources, settings)
    return Lesson(order.name, order.mesh, settings)


classes = (LEGORIZE_OT_learn, LEGORIZE_OT_forget)
register, unregister = bpy.utils.register_classes_factory(classes)
