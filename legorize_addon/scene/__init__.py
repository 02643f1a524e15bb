"""Bricks in Blender's scene: collections, point objects, part meshes and the state of a build."""

from __future__ import annotations

from .animated_tree import FIRST, FRAMES, animated_tree
from .assembly_columns import ASIDE, JOINED, REMOVED, TIER, there_after, way_after
from .brick_points import MARGIN, NO_MARGIN, ROW, box_corners, middles, positions, read_column, read_columns
from .brick_tree import EXPLODE, HEAT_MAP, HEAT_PARTS, HIDDEN_ROLES, PALE, PARTS, STEPS, brick_tree
from .builds import (
    LAYER_KEY,
    ROLE_KEY,
    all_builds,
    bricks_of,
    builds,
    builds_of,
    can_show_ghost,
    check_whole,
    damage,
    ghost_shown,
    is_own,
    layers_of,
    line_objects,
    n_deleted,
    point_objects,
    show_ghost,
    show_sources,
    sources_of,
)
from .collections import clear_build, read_bricks, show_build, steps_of
from .colour_errors import COLOUR_ERROR, colour_error_of, surface_of
from .curves import add_lines
from .duplicates import adopt_copies, copied_roots, is_bare_root, is_copied_root
from .hand_changes import hand_remark
from .hidden_sources import orphans, show_orphans
from .instancing import (
    GHOST_KEY,
    HEAT_KEY,
    MATERIAL_KEY,
    PALE_KEY,
    bricks_modifier,
    change_tree,
    colour_material,
    get_input,
    has_input,
    plastic,
    set_input,
)
from .kept_colours import found_colours, keep_found_colours
from .kept_edits import bricks_text, read_bricks_text
from .lettering import title_for
from .model import Model, Source
from .part_meshes import PART_KEY, Detail, detail_of, parts_collection, parts_in_use, set_detail
from .placing import layer_collections, stand_beside, world_from_mm
from .preview import end_preview, preview_in, previewed, show_preview
from .section import AXES, Section, beyond, hidden_side, place_plane
from .shared_parts import own_parts, sweep
from .state import is_build, state_of
from .verdict import check_lines

__all__ = [
    "ASIDE",
    "AXES",
    "COLOUR_ERROR",
    "EXPLODE",
    "FIRST",
    "FRAMES",
    "GHOST_KEY",
    "HEAT_KEY",
    "HEAT_MAP",
    "HEAT_PARTS",
    "HIDDEN_ROLES",
    "JOINED",
    "LAYER_KEY",
    "MARGIN",
    "MATERIAL_KEY",
    "NO_MARGIN",
    "PALE",
    "PALE_KEY",
    "PARTS",
    "PART_KEY",
    "REMOVED",
    "ROLE_KEY",
    "ROW",
    "STEPS",
    "TIER",
    "Detail",
    "Model",
    "Section",
    "Source",
    "add_lines",
    "adopt_copies",
    "all_builds",
    "animated_tree",
    "beyond",
    "box_corners",
    "brick_tree",
    "bricks_modifier",
    "bricks_of",
    "bricks_text",
    "builds",
    "builds_of",
    "can_show_ghost",
    "change_tree",
    "check_lines",
    "check_whole",
    "clear_build",
    "colour_error_of",
    "colour_material",
    "copied_roots",
    "damage",
    "detail_of",
    "end_preview",
    "found_colours",
    "get_input",
    "ghost_shown",
    "hand_remark",
    "has_input",
    "hidden_side",
    "is_bare_root",
    "is_build",
    "is_copied_root",
    "is_own",
    "keep_found_colours",
    "layer_collections",
    "layers_of",
    "line_objects",
    "middles",
    "n_deleted",
    "orphans",
    "own_parts",
    "parts_collection",
    "parts_in_use",
    "place_plane",
    "plastic",
    "point_objects",
    "positions",
    "preview_in",
    "previewed",
    "read_bricks",
    "read_bricks_text",
    "read_column",
    "read_columns",
    "set_detail",
    "set_input",
    "show_build",
    "show_ghost",
    "show_orphans",
    "show_preview",
    "show_sources",
    "sources_of",
    "stand_beside",
    "state_of",
    "steps_of",
    "surface_of",
    "sweep",
    "there_after",
    "title_for",
    "way_after",
    "world_from_mm",
]
