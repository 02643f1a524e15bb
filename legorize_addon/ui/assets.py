"""A finished model as an asset: found by picture and tags in the Asset Browser, and put into other files from there."""

from __future__ import annotations

from typing import Final

import bpy
from bpy.app.translations import pgettext_rpt as rpt

from ..scene import state_of
from . import counts
from .current import current_build
from .export import title_of
from .working import OnBuild

TAGS: Final = ("bricks", "legorize")
"""Words by which every model is found."""


class LEGORIZE_OT_mark_asset(OnBuild, bpy.types.Operator):
    """Mark the build that the panel shows as an asset."""

    bl_idname = "legorize.mark_asset"
    bl_label = "Mark as Asset"
    bl_description = (
        "Keep the model as an asset with a picture and tags: the Asset Browser shows it, and puts copies of it into "
        "other files"
    )
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Mark its collection, with the figures of the model as the description."""
        build = current_build(context.scene)
        build.asset_mark()
        summary = state_of(build).summary
        extent = counts.extent(summary["studs_x"], summary["studs_y"], summary["layers"])
        build.asset_data.description = f"{counts.bricks(summary['bricks'])}, {extent}"
        for tag in (*TAGS, title_of(build)):
            build.asset_data.tags.new(tag, skip_if_exists=True)
        if not bpy.app.background:
            # a picture takes a window
            build.asset_generate_preview()
        self.report({"INFO"}, rpt("Asset {!r}: save the file in a folder of an asset library.").format(build.name))
        return {"FINISHED"}


register, unregister = bpy.utils.register_classes_factory((LEGORIZE_OT_mark_asset,))
