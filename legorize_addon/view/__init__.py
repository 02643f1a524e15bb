"""What is shown of a build: layers, roles, a cut, building steps, the heat map, colour errors."""

from __future__ import annotations

from .animation import Animation, animate, animation_of
from .colour_errors import (
    ERROR_LEGEND,
    colour_error_lines,
    colour_errors_shown,
    has_colour_errors,
    show_colour_errors,
    show_worst_colour,
)
from .edited import Changed, change, edits_of, outcomes_in, show_changed, touching, without
from .heat_map import LEGEND, has_margins, heat_map_shown, show_heat_map
from .highlight import can_highlight, highlight_step, highlighted
from .lots import show_lot, shown_lot
from .method import (
    STEP_KEY,
    STEPS,
    MethodView,
    Step,
    has_trajectories,
    show_method,
    show_trajectories,
    shows_step,
    trajectories_shown,
)
from .numbers import Numbers, brick_numbers
from .picking import brick_under, edges_of
from .show_result import show_result
from .steps import check_steps, explode, exploded, n_pieces, n_steps, steps_done
from .tint import hide_tint
from .visibility import (
    corners_while_building,
    cut_away,
    readable,
    roles_shown,
    section_of,
    show_layers,
    show_role,
    show_steps,
    shown_corners,
    stop_animation,
)
from .weakest import show_weakest

__all__ = [
    "ERROR_LEGEND",
    "LEGEND",
    "STEPS",
    "STEP_KEY",
    "Animation",
    "Changed",
    "MethodView",
    "Numbers",
    "Step",
    "animate",
    "animation_of",
    "brick_numbers",
    "brick_under",
    "can_highlight",
    "change",
    "check_steps",
    "colour_error_lines",
    "colour_errors_shown",
    "corners_while_building",
    "cut_away",
    "edges_of",
    "edits_of",
    "explode",
    "exploded",
    "has_colour_errors",
    "has_margins",
    "has_trajectories",
    "heat_map_shown",
    "hide_tint",
    "highlight_step",
    "highlighted",
    "n_pieces",
    "n_steps",
    "outcomes_in",
    "readable",
    "roles_shown",
    "section_of",
    "show_changed",
    "show_colour_errors",
    "show_heat_map",
    "show_layers",
    "show_lot",
    "show_method",
    "show_result",
    "show_role",
    "show_steps",
    "show_trajectories",
    "show_weakest",
    "show_worst_colour",
    "shown_corners",
    "shown_lot",
    "shows_step",
    "steps_done",
    "stop_animation",
    "touching",
    "trajectories_shown",
    "without",
]
