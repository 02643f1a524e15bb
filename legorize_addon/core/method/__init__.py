"""What the steps before the layout look like: trajectories, their hierarchy, unit bricks, hollowing, layer by layer."""

from __future__ import annotations

from .files import method_files
from .lines import Lines, trajectory_lines
from .trajectory_maps import Shown
from .unit_models import hollowed_model, initial_model

__all__ = ["Lines", "Shown", "hollowed_model", "initial_model", "method_files", "trajectory_lines"]
