"""Whether what is in place holds by forces at every moment: the static equilibrium of each step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Ints
from ..model import Assembly, Verdict
from ..progress import Progress, silent
from ..statics import stability
from .moves import Action
from .steps import Steps


@dataclass(frozen=True, slots=True, eq=False)
class Proof:
    """Verdicts on the steps of a building order.

    Attributes
    ----------
    steps : (n,) int64 array
        Steps at whose end the bricks in place were tested.
    collapsing : int64 array
        Those of them after which something is proven to fall.
    undecided : int64 array
        Those of which neither is proven.
    wedged : int64 array
        Those that are proven to stand only while bricks side by side press on
        each other.
    """

    steps: Ints
    collapsing: Ints
    undecided: Ints
    wedged: Ints

    @property
    def stands(self) -> bool:
        """Whether every step is proven to stand, be it while neighbours press on each other."""
        return len(self.collapsing) == len(self.undecided) == 0


def prove_steps(steps: Steps, assembly: Assembly, *, clutch: float, progress: Progress = silent) -> Proof:
    """Test the bricks in place after every step by forces.

    Each submodel is tested on its own table; what others have built there is not
    looked at again until it is joined.

    Parameters
    ----------
    steps : Steps
        The order.
    assembly : Assembly
        Model and supports.
    clutch : float
        Pull in N that one contact point bears.
    progress : Progress
        Told before each step; may cancel.

    Returns
    -------
    Proof
    """
    group = steps.submodel_of(len(assembly))
    placed = np.zeros(len(assembly.bricks), dtype=bool)
    verdicts, numbers = [], []
    for step in steps:
        progress("proof", step.number / len(steps))
        placed[step.bricks] = step.action != Action.REMOVE
        for each in step.joined:
            group[group == each] = step.submodel
        found = stability(assembly.take(placed & (group == step.submodel)), clutch=clutch)
        verdicts.append(found.verdict)
        numbers.append(step.number)
    tested = np.array(numbers, dtype=np.int64)
    told = (Verdict.COLLAPSES, Verdict.UNDECIDED, Verdict.WEDGED)
    return Proof(tested, *(tested[[verdict is each for verdict in verdicts]] for each in told))
