"""Mosaics: the image that is chosen, the button that builds one, and their panel."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt
from bpy.app.translations import pgettext_tip as tip

from ..core.errors import BuildError, MeshError
from ..core.progress import Progress
from ..core.settings import Settings
from ..core.units import MM_PER_METRE
from ..reading import image_of
from ..scene import Source, builds, sources_of
from ..view import show_result
from . import counts, job
from .current import current_build
from .kept_texts import with_texts
from .parts import list_parts_of
from .requests import absolute_files, by_uid
from .settings_properties import settings_of, take_renamed
from .working import BUSY, Working

if TYPE_CHECKING:
    from ..core.build import Mosaic
    from ..core.mosaic import Picture


@dataclass(frozen=True, slots=True, eq=False)
class ImageRequest:
    """What a mosaic is made of, read on the main thread.

    Attributes
    ----------
    name : str
        Of the image.
    scene : int
        Session identifier of the scene that gets the mosaic.
    picture : Picture
    remarks : tuple of str
        What could not be read literally.
    settings : Settings
        The user's choices.
    files : mapping of str to str
        Absolute paths of the files that settings name, by the setting.
    mm_per_unit : float
        World mm per Blender unit.
    replaces : tuple of int
        Session identifiers of the builds whose place it takes: earlier mosaics of this image.
    """

    name: str
    scene: int
    picture: Picture
    remarks: tuple[str, ...]
    settings: Settings
    files: Mapping[str, Any]
    mm_per_unit: float
    replaces: tuple[int, ...]

    def work(self, progress: Progress) -> Mosaic:
        """Run the core; no Blender in here."""
        from ..core.pipeline import legorize_image

        made = legorize_image(self.picture, replace(self.settings, **self.files), progress)
        made = replace(made, settings=self.settings)
        return with_texts(made, title=self.name, remarks=self.remarks, mm_per_unit=self.mm_per_unit)


class LEGORIZE_OT_image(Working, bpy.types.Operator):
    """Make a mosaic of an image."""

    bl_idname = "legorize.image"
    bl_label = "Legorize Image"
    bl_description = (
        "Turn the chosen image, else that of the selected empty, into a mosaic, which replaces the earlier one of it"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether there is an image, and why not."""
        if job.running():
            cls.poll_message_set(tip(BUSY))
        elif _chosen(context) is None:
            cls.poll_message_set(tip("Choose an image, or select an empty that shows one."))
        else:
            return True
        return False

    def _take_order(self, context: bpy.types.Context) -> ImageRequest:
        image = _chosen(context)
        if image is None:
            raise MeshError("There is no image: choose one, or select an empty that shows one.")
        from ..reading import picture_from

        renamed = take_renamed(context.scene.legorize.settings)
        picture, remarks = picture_from(image)
        settings = settings_of(context.scene.legorize.settings)
        return ImageRequest(
            name=image.name,
            scene=context.scene.session_uid,
            picture=picture,
            remarks=(*renamed, *remarks),
            settings=settings,
            files=absolute_files(settings),
            mm_per_unit=context.scene.unit_settings.scale_length * MM_PER_METRE,
            replaces=tuple(build.session_uid for build in _mosaics_of(context.scene, image.name)),
        )

    def _show(self, context: bpy.types.Context, order: ImageRequest, mosaic: Mosaic) -> set[str]:
        [scene] = by_uid(bpy.data.scenes, [order.scene]) or [None]
        if scene is None:
            raise BuildError(
                "The scene was deleted while its mosaic was being built: open another one and start again."
            )
        notes = (*order.remarks, *mosaic.notes)
        view = scene.legorize
        view.build = show_result(
            scene,
            mosaic,
            Source(order.name, (), notes=notes),
            mm_per_unit=order.mm_per_unit,
            detail=view.detail,
            replaces=by_uid(bpy.data.collections, order.replaces),
        )
        view.build[IMAGE_KEY] = order.name
        list_parts_of(view.build, mosaic)
        across, deep = mosaic.canvas.size
        told = rpt("Mosaic built: {} on {} x {} studs.").format(counts.bricks(len(mosaic.bricks)), across, deep)
        self.report({"INFO"}, told)
        for note in notes:
            self.report({"WARNING"}, note)
        return {"FINISHED"}


IMAGE_KEY = "legorize_image"
"""Custom property of a build: the name of the image that it shows."""


def _chosen(context: bpy.types.Context) -> bpy.types.Image | None:
    """Return the image of the panel, else that of a selected empty."""
    return context.scene.legorize.image or image_of(context.selected_objects)


def _mosaics_of(scene: bpy.types.Scene, name: str) -> Sequence[bpy.types.Collection]:
    """Return the mosaic of an image that the panel shows, else the newest one."""
    found = [build for build in builds(scene) if build.get(IMAGE_KEY) == name and not sources_of(build)]
    shown = [build for build in found if build == current_build(scene)]
    return shown or found[-1:]


class LEGORIZE_PT_image(bpy.types.Panel):
    """The image, what the mosaic is made of, and the button."""

    bl_label = "Mosaic of an Image"
    bl_parent_id = "LEGORIZE_PT_main"
    bl_options = {"DEFAULT_CLOSED"}
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Legorize"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw what is chosen, with a file browser to open others."""
        self.layout.enabled = job.running() is None
        self.layout.template_ID(context.scene.legorize, "image", open="image.open")
        column = self.layout.column()
        column.use_property_split = True
        column.use_property_decorate = False
        for name in ("mosaic", "standing", "dithering", "border"):
            column.prop(context.scene.legorize.settings, name)
        self.layout.operator(LEGORIZE_OT_image.bl_idname, icon="IMAGE_DATA")


register, unregister = bpy.utils.register_classes_factory((LEGORIZE_OT_image, LEGORIZE_PT_image))
