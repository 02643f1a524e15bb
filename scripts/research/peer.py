"""The peer ``legolization`` on the same cells: it runs in a Python of its own, as a process.

It takes no corner parts, has plates besides bricks, and lays every part in every
colour; it knows cells of any colour, as we do.
"""

from __future__ import annotations

import json
import subprocess
import tempfile
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from legorize_addon.core.errors import BuildError
from legorize_addon.core.model.unit_grid import COLOUR_ANY, UnitGrid

PROGRAM: Final = Path(__file__).with_name("peer_layout.py")

STRATEGIES: Final = ("greedy", "bond")

EMPTY: Final = -1
ANY: Final = -2
"""The peer's numbers for cells without brick and without colour."""

Facts = dict[str, Any]


def codes_of(grid: UnitGrid) -> NDArray[np.int16]:
    """Return the cells of a model of bricks as the peer reads them.

    Parameters
    ----------
    grid : UnitGrid
        Every column of three plates of one colour.

    Returns
    -------
    (n_x, n_y, n_layers) int16 array
        LDraw codes, ``EMPTY`` or ``ANY``.
    """
    colour = np.where(grid.colour == COLOUR_ANY, np.int16(ANY), grid.colour)
    codes = np.where(grid.solid, colour, np.int16(EMPTY))[:, 0]
    return np.ascontiguousarray(codes.transpose(2, 1, 0))


def laid_by_peer(python: Path, grid: UnitGrid, strategy: str, how: str, limit: float | None = None) -> Facts | None:
    """Let the peer lay a model.

    Parameters
    ----------
    python : Path
        Of the environment in which the peer is installed.
    grid : UnitGrid
        Cells to build, all of them.
    strategy : str
        One of the peer's.
    how : {"bare", "whole"}
        Whether it only lays, or also does what it does to make the bricks hold.
    limit : float, optional
        Seconds that it may take.

    Returns
    -------
    dict or None
        ``version``, ``bricks``, ``seconds`` of the processor, ``components`` and
        ``floating``; None if it took longer.

    Raises
    ------
    BuildError
        The peer fails, in its own words.
    """
    with tempfile.TemporaryDirectory() as folder:
        cells = Path(folder) / "cells.npy"
        np.save(cells, codes_of(grid))
        # -P keeps the modules beside the program from hiding others of the same name
        line = [str(python), "-P", str(PROGRAM), str(cells), strategy, how]
        try:
            done = subprocess.run(line, capture_output=True, text=True, check=False, timeout=limit)
        except subprocess.TimeoutExpired:
            return None
    if done.returncode:
        last = (done.stderr.strip() or "no message").splitlines()[-1]
        raise BuildError(f"The peer failed in {python}: {last}")
    facts: Facts = json.loads(done.stdout.splitlines()[-1])
    return facts
