"""The peer's side of the comparison: a program for the Python of an environment with ``legolization``.

::

    PYTHON -P peer_layout.py CELLS.npy STRATEGY {bare,whole}

CELLS.npy holds LDraw codes by x, y and layer of bricks, -1 where nothing is built
and -2 where any colour will do, which is what the peer means by these numbers. The
last line of the output is a JSON object. Nothing is hollowed, and no instructions
are made: *bare* lays the bricks, *whole* also does everything that the peer does
by default to make them stable. Seconds are those of the processor, without
reading and starting.
"""

from __future__ import annotations

import json
import sys
import time
from importlib.metadata import version

import numpy as np
from legolization.catalog import default_catalog
from legolization.graph import ConnectionGraph
from legolization.grid import VoxelGrid
from legolization.instructions.sequencer import InstructionsConfig
from legolization.pipeline import PipelineConfig, run
from legolization.placement.registry import make_strategy

PLATES = 3


def main(path: str, strategy: str, how: str) -> None:
    """Lay the cells of a file and print what came out."""
    cells = np.load(path)
    grid = VoxelGrid(codes=np.repeat(cells, PLATES, axis=2).astype(np.int16))
    start = time.process_time()
    layout = bare(grid, strategy) if how == "bare" else whole(grid, strategy)
    seconds = time.process_time() - start
    graph = ConnectionGraph.from_layout(layout)
    facts = {
        "version": version("legolization"),
        "bricks": len(layout),
        "seconds": seconds,
        "components": graph.component_count(),
        "floating": len(graph.floating_ids()),
    }
    print(json.dumps(facts))


def bare(grid, strategy):
    """Return the peer's layout before it tries to make it hold."""
    catalog = default_catalog()
    config = PipelineConfig(strategy=strategy, refine=False, connectivity_fail_max=0)
    return make_strategy(strategy, catalog=catalog, config=config).place(grid, rng=np.random.default_rng(config.seed))


def whole(grid, strategy):
    """Return the layout that the peer's own run ends with."""
    config = PipelineConfig(
        strategy=strategy, hollow=False, ignore_interior=False, instructions=InstructionsConfig(mode="layer")
    )
    return run(grid, config).layout


if __name__ == "__main__":
    main(*sys.argv[1:])
