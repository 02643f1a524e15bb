"""Requests to build: which objects, read on the main thread, with which settings, and which builds they replace."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_tip as tip

from ..core.edits import NO_EDITS, Edits
from ..core.progress import Progress
from ..core.setting import SEPARATOR
from ..core.settings import Settings
from ..core.units import MM_PER_METRE
from ..reading import has_surface
from ..scene import builds_of, end_preview, is_own, orphans, previewed, sources_of, state_of
from ..view import edits_of, readable
from .current import current_build
from .kept_texts import with_texts
from .learned_files import resolved

if TYPE_CHECKING:
    from ..core.build import Build
    from ..core.memo import Trial
    from ..core.mesh import TriangleMesh


@dataclass(frozen=True, slots=True, eq=False)
class BuildRequest:
    """What a build is made of, read on the main thread.

    Attributes
    ----------
    name : str
        Of the model: the names of its source objects.
    scene : int
        Session identifier of the scene that gets the model.
    sources : tuple of int
        Session identifiers of the objects: references to them would not outlive an undo, and a linked object and one of
        the file may have the same name.
    mesh : TriangleMesh
        Their surface.
    remarks : tuple of str
        What could not be read literally.
    settings : Settings
        The user's choices.
    samples : str
        Path of the file that the settings name in ``learned_from``.
    files : mapping of str to str
        Absolute paths of the other files that settings name, by the setting.
    mm_per_unit : float
        World mm per Blender unit.
    replaces : tuple of int
        Session identifiers of the builds whose place it takes.
    edits : Edits
        Changes by hand of these, to be made again.
    trial : Trial or None
        What earlier runs of the session have found.
    """

    name: str
    scene: int
    sources: tuple[int, ...]
    mesh: TriangleMesh
    remarks: tuple[str, ...]
    settings: Settings
    samples: str
    files: Mapping[str, Any]
    mm_per_unit: float
    replaces: tuple[int, ...]
    edits: Edits = NO_EDITS
    trial: Trial | None = None

    def check_limits(self) -> None:
        """Raise ``LimitError`` if the model would be larger than the limits of the settings."""
        from ..core.estimate import estimate
        from ..core.limits import check_limits

        check_limits(estimate(self.mesh, self.settings), self.settings)

    def within_limits(self) -> BuildRequest:
        """Return the same with limits that allow it."""
        from ..core.estimate import estimate
        from ..core.limits import within_limits

        return replace(self, settings=within_limits(estimate(self.mesh, self.settings), self.settings))

    def work(self, progress: Progress) -> Build:
        """Run the core; no Blender in here."""
        from ..core.pipeline import legorize

        build = legorize(
            self.mesh,
            replace(self.settings, learned_from=self.samples, **self.files),
            progress,
            edits=self.edits,
            trial=self.trial,
        )
        # the scene keeps the name that holds on every machine
        build = replace(build, settings=self.settings)
        return with_texts(build, title=self.name, remarks=self.remarks, mm_per_unit=self.mm_per_unit)


def chosen_sources(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Return the objects to legorize, by name.

    These are the selected objects with a surface, for a selected brick model
    the objects it was made of, and with nothing selected those of the model
    that the panel shows, or what a model hid that was deleted since.
    """
    shown = previewed(context.scene)
    if shown and not context.selected_objects:
        # which hides them, or their model
        return shown
    selected = [thing for thing in context.selected_objects if not is_own(thing) and has_surface(thing)]
    models = builds_of(context.scene, [thing for thing in context.selected_objects if is_own(thing)])
    if not selected and not models and current_build(context.scene):
        models = [current_build(context.scene)]
    again = [source for model in models for source in sources_of(model)]
    if not selected and not models:
        again = [entry.source for entry in orphans(context.scene) if has_surface(entry.source)]
    here = {thing for thing in (*selected, *again) if context.scene in thing.users_scene}
    return sorted(here, key=lambda thing: (thing.name, thing.library.filepath if thing.library else ""))


def why_nothing(scene: bpy.types.Scene, layer: bpy.types.ViewLayer, usual: str) -> str:
    """Return why nothing is chosen: that nothing is selected, or that what could be is hidden or out of reach.

    Parameters
    ----------
    scene : bpy.types.Scene
    layer : bpy.types.ViewLayer
        In which one selects.
    usual : str
        English sentence for where there is something to select.

    Returns
    -------
    str
        In the language of tooltips.
    """
    able = sorted(
        (thing for thing in scene.objects if not is_own(thing) and has_surface(thing)), key=lambda it: it.name
    )
    if not able or any(thing.visible_get(view_layer=layer) for thing in able):
        return tip(usual)
    for thing in able:
        if thing.name in layer.objects:
            return tip("{!r} is hidden: show it in the outliner and select it.").format(thing.name)
    return tip("{!r} is in a collection that is unticked in the outliner: tick it, and select the object.").format(
        able[0].name
    )


def replaced_by(context: bpy.types.Context, sources: Sequence[bpy.types.Object]) -> list[bpy.types.Collection]:
    """Return the builds whose place a build of some sources takes.

    Of several models of the same objects, such as copies, only the selected
    ones are replaced, else the one that the panel shows, else the newest.
    """
    same: dict[frozenset[bpy.types.Object], list[bpy.types.Collection]] = {}
    for build in builds_of(context.scene, sources):
        same.setdefault(frozenset(sources_of(build)), []).append(build)
    selected = {thing for thing in context.selected_objects if is_own(thing)}
    replaced = []
    for group in same.values():
        chosen = [build for build in group if selected & set(build.all_objects)]
        shown = [build for build in group if build == current_build(context.scene)]
        replaced += chosen or shown or group[-1:]
    return replaced


def build_request(context: bpy.types.Context, sources: Sequence[bpy.types.Object], settings: Settings) -> BuildRequest:
    """Read objects, which may be hidden, for a build; what a preview stands for is there again.

    Parameters
    ----------
    context : bpy.types.Context
        Its scene has the objects.
    sources : sequence of bpy.types.Object
        With a surface.
    settings : Settings
        Of the build.

    Returns
    -------
    BuildRequest
    """
    from ..reading import read_objects

    end_preview(context.scene, context.view_layer)
    with readable(context, sources):
        context.view_layer.update()
        mesh, remarks = read_objects(sources, context.evaluated_depsgraph_get(), weight=settings.weight)
    replaced = replaced_by(context, sources)
    return BuildRequest(
        name=" + ".join(source.name for source in sources),
        scene=context.scene.session_uid,
        sources=tuple(source.session_uid for source in sources),
        mesh=mesh,
        remarks=remarks,
        settings=settings,
        samples=resolved(settings.learned_from),
        files=absolute_files(settings),
        mm_per_unit=context.scene.unit_settings.scale_length * MM_PER_METRE,
        replaces=tuple(model.session_uid for model in replaced),
        edits=next((edits_of(model) for model in replaced if state_of(model).edits[0]), NO_EDITS),
    )


def resolved_settings(settings: Settings) -> Settings:
    """Return settings with the paths by which a run finds the files that they name."""
    return replace(settings, learned_from=resolved(settings.learned_from), **absolute_files(settings))


def absolute_files(settings: Settings) -> dict[str, Any]:
    """Return the settings that name files, with paths that do not depend on where the .blend is."""
    named = [entry.name for entry in fields(Settings) if entry.metadata["files"]]
    paths = {name: getattr(settings, name).split(SEPARATOR) for name in named if getattr(settings, name)}
    return {name: SEPARATOR.join(bpy.path.abspath(path.strip()) for path in each) for name, each in paths.items()}


def by_uid(blocks: Iterable[bpy.types.ID], uids: Sequence[int]) -> list[Any]:
    """Return the datablocks with some session identifiers, without those deleted since."""
    there = {block.session_uid: block for block in blocks}
    return [there[uid] for uid in uids if uid in there]
