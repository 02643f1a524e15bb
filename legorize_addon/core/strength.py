"""What the settings mean for whether a model stands: ties, pillars, tests by force, and lots that may go."""

from __future__ import annotations

from .building import Proof, prove_steps
from .layout import recolour_visible
from .layout.joining import add_ties
from .model import Assembly, Bricks, UnitGrid, Verdict, contact_graph
from .run import Run
from .statics import PROGRAMME, Effort, Stability, stability
from .supports import AssemblyPlan, add_bracing, add_pillars, of_the_paper, strengthen


def tie_parts(run: Run, bricks: Bricks, shell: UnitGrid) -> tuple[Bricks, UnitGrid]:
    """Join parts that hang together by themselves alone; return the cells that the bricks cover as well."""
    return add_ties(bricks, shell, run.parts.joining, plates=run.settings.plates != "none")


def strengthen_joints(
    run: Run, bricks: Bricks, shell: UnitGrid, *, most: int | None = None
) -> tuple[Bricks, UnitGrid, Stability | None]:
    """Tie what is weak, if that is wanted, in so many rounds; say how it stands with something to spare, too."""
    if not run.settings.strengthen:
        return bricks, shell, None
    return strengthen(
        bricks,
        shell,
        run.parts.joining,
        clutch=(1 - run.settings.spare) * run.settings.clutch,
        plates=run.settings.plates != "none",
        most=most,
        progress=run.progress,
    )


def show_colours(run: Run, bricks: Bricks, shell: UnitGrid) -> Bricks:
    """Give hidden bricks the colours of what is seen of them."""
    return recolour_visible(bricks, shell, contact_graph(bricks, run.catalogue), run.catalogue)


def carry(run: Run, assembly: Assembly) -> Assembly:
    """Put pillars under what floats, if there may be supports."""
    if not run.settings.supported:
        return assembly
    if run.settings.support_parts == "all":
        return add_pillars(assembly)
    return Assembly(add_pillars(Assembly(assembly.bricks, of_the_paper(run.catalogue))).bricks, run.catalogue)


def check_strong(run: Run, assembly: Assembly, sparing: Stability | None) -> Stability | None:
    """Test the bricks by force if they stand with something to spare, or if nothing can be put under them.

    What else is None: pillars will stand there, and this is soon known of the model with them.
    """
    known = _known(sparing, assembly)
    if run.settings.supported and known is not None and known.standing is not Verdict.STABLE:
        return None
    return check_stability(run, assembly, sparing)


def _known(found: Stability | None, assembly: Assembly) -> Stability | None:
    """Return what was found if it is about all of these bricks, and none of them was added since."""
    return found if found is not None and len(found.margin) == len(assembly) else None


def check_stability(run: Run, assembly: Assembly, near: Stability | None) -> Stability:
    """Test the bricks by force, from what is known of nearly the same ones, maybe with less clutch.

    Where there may be pillars, it is not asked yet whether neighbours hold what studs do not.
    """
    alone = not run.settings.supported
    effort = Effort(near=near, programme=PROGRAMME if alone else 0, neighbours=alone)
    return stability(assembly, clutch=run.settings.clutch, effort=effort, progress=run.progress)


def brace(
    run: Run, assembly: Assembly, found: Stability | None, sparing: Stability | None
) -> tuple[Assembly, Stability]:
    """Put pillars under what studs do not bear, if that is wanted, and keep to the owned parts.

    How the layout stands with something to spare is known from its ties.
    """
    settings = run.settings
    if found is None or (settings.supported and settings.strengthen):
        options = {"clutch": settings.clutch, "spare": settings.spare}
        known = _known(sparing, assembly)
        assembly, found = add_bracing(assembly, found, known=known, **options, progress=run.progress)
    settled = run.parts.settled(assembly)
    if settled is assembly:
        return assembly, found
    return settled, stability(settled, clutch=settings.clutch, progress=run.progress)


def take_fewer_lots(run: Run, assembly: Assembly, found: Stability) -> tuple[Assembly, Stability, tuple[str, ...]]:
    """Lay other parts in place of small lots, if that is wanted and the model stands as well; say what was done."""
    other, sentence = run.parts.exchanged(assembly)
    if other is assembly:
        return assembly, found, ()
    tested = like_before(run, other, found, Effort(programme=0))
    if weaker(tested, found):
        return assembly, found, ()
    return other, stability(other, clutch=run.settings.clutch, effort=Effort(near=tested)), (sentence,)


def like_before(run: Run, other: Assembly, found: Stability, effort: Effort) -> Stability:
    """Test bricks that may lie in the place of others with as much to spare as these have."""
    spare = run.settings.spare if found.stable and found.margin.min(initial=1.0) >= run.settings.spare else 0.0
    return stability(other, clutch=(1 - spare) * run.settings.clutch, effort=effort, progress=run.progress)


def weaker(tested: Stability, found: Stability) -> bool:
    """Tell whether bricks do not stand as well as others did."""
    return (found.stable and not tested.stable) or (found.stands and not tested.stands)


def check_final(run: Run, assembly: Assembly, near: Stability | None = None) -> Stability:
    """Test the model with all that stays in it by force, from the proof that it stood before, if there is one."""
    if near is not None and near.stable:
        # with as much to spare, if that is soon found
        near = like_before(run, assembly, near, Effort(near=near, programme=0, neighbours=False))
    effort = Effort(near=near if near is not None and near.stable else None)
    return stability(assembly, clutch=run.settings.clutch, effort=effort, progress=run.progress)


def prove(run: Run, plan: AssemblyPlan) -> Proof:
    """Test every building step by forces."""
    return prove_steps(plan.steps, plan.assembly, clutch=run.settings.clutch, progress=run.progress)
