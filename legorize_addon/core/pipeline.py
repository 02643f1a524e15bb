"""The stages in order: with those of :mod:`.drafting`, which come first, the one place that knows it."""

from __future__ import annotations

from dataclasses import asdict, replace
from functools import partial

import numpy as np

from .beyond import Beyond, beyond_paper
from .build import Build, Draft, Judged, Mosaic
from .building import Proof
from .drafting import drafted, stand_up
from .edits import NO_EDITS, Edits
from .erecting import erect, put_up
from .errors import SettingsError, enough_memory
from .estimate import COUNTED, estimate
from .existing import (
    EXPECTED,
    SHOWN,
    Existing,
    StepsFrom,
    laid_again,
    moved_up,
    plan_existing,
    remarks_on_plan,
    without_overlaps,
)
from .fitting import fit
from .half_stages import Barred, remarks_on_half_studs, with_half_studs
from .limits import check_limits, check_size
from .memo import Trial
from .mesh import TriangleMesh
from .model import Assembly
from .mosaic import Covered, Picture
from .mosaic_estimate import estimate_mosaic
from .mosaic_stages import lay_mosaic, mosaic_canvas, mosaic_colours, remarks_on_mosaic, wall_cells
from .native import watched
from .part_choice import PartChoice
from .presets import follows
from .progress import Overall, Progress, silent
from .report import (
    remarks,
    remarks_on_building,
    remarks_on_edits,
    remarks_on_owned,
    remarks_on_prices,
    remarks_on_proof,
    remarks_on_split,
)
from .run import Run
from .settings import Settings
from .shortage import with_enough_parts
from .stages import hollow_by, make_plan
from .statics import Stability
from .stock import Owned
from .strength import (
    check_final,
    check_stability,
    prove,
)
from .supports import AssemblyPlan
from .tile_stages import without_proof
from .unit_bricks import remarks_on_dithering


@enough_memory()
def legorize(
    mesh: TriangleMesh,
    settings: Settings,
    progress: Progress = silent,
    *,
    edits: Edits = NO_EDITS,
    trial: Trial | None = None,
) -> Build:
    """Turn a textured mesh into a brick model.

    Parameters
    ----------
    mesh : TriangleMesh
        As read, in world mm.
    settings : Settings
    progress : Progress
        Called at least once a second with the current stage, or its current part, and the share of the whole run that
        is done, which never decreases.
    edits : Edits, optional
        Changes by hand, which are made again.
    trial : Trial, optional
        Of a memo: what earlier runs have found is taken over where it would be found again. The result is the same.

    Returns
    -------
    Build

    Raises
    ------
    LegorizeError
        The mesh or the settings cannot be used, in one sentence.
    """
    if settings.half_studs and edits.edits:
        raise SettingsError("half_studs is on, but there are edits by hand, which need one grid: turn half_studs off.")
    make = partial(with_enough_parts, partial(with_half_studs, partial(_legorize, edits, trial)))
    if settings.size_by in COUNTED:
        return watched(partial(fit, mesh, settings, make), progress)
    return watched(partial(make, mesh, settings), progress)


def _legorize(
    edits: Edits, trial: Trial | None, barred: Barred, mesh: TriangleMesh, settings: Settings, progress: Progress
) -> Build:
    """Go through the stages; nothing lies half a stud further on from barred levels on."""
    check_limits(expected := estimate(mesh, settings), settings)
    run = Run.of(settings, Overall(expected.stages, progress), trial)
    made, told = drafted(run, mesh, barred)
    up = erect(run, made, edits)
    made, plan, found, by_hand = up.made, up.plan, up.found, up.by_hand
    proof = _prove(run, plan)
    beyond = _beyond_paper(run, made, plan)
    run.progress.finish()
    notes = (
        *made.repairs.sentences(), *told, *remarks_on_dithering(made.mesh, settings.dithering), *run.learning,
        *((beyond.sentence(),) if beyond else ()), *up.remarks,
        *remarks_on_half_studs(made.halves, plan.final.bricks, run.catalogue),
        *remarks_on_edits(outcomes := by_hand.outcomes(plan.final), run.catalogue),
        *_notes(run, found, plan, proof, run.parts.owned), *remarks_on_split(plan, most=settings.split),
    )  # fmt: skip
    return Build(
        settings=settings, mesh=made.mesh, repairs=made.repairs, scale=made.scale, turn=made.turn,
        surface=made.surface, cut=made.cut, trajectories=made.trajectories, offsets=made.offsets, grid=made.grid,
        hollow=up.shell, wanted=made.wanted, edits=by_hand.edits, outcomes=outcomes,
        unedited=without_proof(run, by_hand), assembly=plan.final, stability=found, supports=plan,
        joints=up.joints, **run.parts.files, proof=proof, notes=notes, timings=run.timings, halves=made.halves,
        beyond=asdict(beyond) if beyond else {},
    )  # fmt: skip


def _beyond_paper(run: Run, made: Draft, plan: AssemblyPlan) -> Beyond | None:
    """Count the repairs that the paper does not have, if the model is made as in the paper."""
    settings = run.settings
    if not follows(asdict(settings), "paper"):
        return None
    hollowed, plates = hollow_by(settings, made.grid), settings.plates != "none"
    return beyond_paper(made, hollowed, plan.final.bricks, plates=plates, ties=sum(run.ties))


@enough_memory()
def legorize_image(picture: Picture, settings: Settings, progress: Progress = silent) -> Mosaic:
    """Turn an image into a mosaic.

    Parameters
    ----------
    picture : Picture
    settings : Settings
    progress : Progress
        As for :func:`legorize`.

    Returns
    -------
    Mosaic

    Raises
    ------
    LegorizeError
        The image or the settings cannot be used, in one sentence.
    """
    return watched(partial(_legorize_image, picture, settings), progress)


def _legorize_image(picture: Picture, settings: Settings, progress: Progress) -> Mosaic:
    """Go through the stages of a mosaic."""
    canvas = mosaic_canvas(picture, settings)
    expected = estimate_mosaic(canvas.size, settings)
    check_limits(expected, settings)
    # a picture keeps its colours: what is not owned is listed
    run = Run.of(replace(settings, owned_use="first"), Overall(expected.stages, progress))
    with run.stage("colours"):
        goal, colour = mosaic_colours(run, picture, canvas)
    if settings.standing:
        shell, told = stand_up(run, wall_cells(run, canvas, colour))
        assembly, _, found, _ = put_up(run, shell, NO_EDITS, 1.0)
        covered = Covered(assembly.bricks, 0, 0)
    else:
        with run.stage("layout"):
            covered = lay_mosaic(run, canvas, colour)
        with run.stage("stability"):
            assembly, told = Assembly(covered.bricks, run.catalogue), ()
            found = check_stability(run, assembly, None)
    with run.stage("supports"):
        plan = run.once(make_plan, assembly)
    proof = _prove(run, plan)
    run.progress.finish()
    notes = (*told, *remarks_on_mosaic(picture, canvas, covered), *_notes(run, found, plan, proof, run.parts.owned))
    return Mosaic(
        settings=settings, scale=1.0, pixels=picture.size, canvas=canvas, goal=goal, colour=colour, covered=covered,
        assembly=plan.final, stability=found, supports=plan, joints=(), **run.parts.files, proof=proof,
        notes=notes, timings=run.timings,
    )  # fmt: skip


@enough_memory()
def judge(
    given: Existing,
    settings: Settings,
    *,
    again: bool = False,
    steps: StepsFrom = "file",
    scale: float = SHOWN,
    progress: Progress = silent,
) -> Judged:
    """Find out whether a brick model stands and how it is built, and lay it again if that is wanted.

    Parameters
    ----------
    given : Existing
        The model.
    settings : Settings
        Those of layout, supports, check and limits count.
    again : bool, optional
        Whether to look for a layout of the same cells and colours in fewer
        bricks.
    steps : {"file", "new"}, optional
        Whether an author's steps are kept; a model that has none, or is laid
        again, gets new ones in any case.
    scale : float, optional
        Model mm per world mm, for the scene.
    progress : Progress, optional

    Returns
    -------
    Judged

    Raises
    ------
    BuildError
        There are no bricks.
    LimitError
        The model is larger than the settings allow.
    """
    return watched(partial(_judge, given, settings, again, steps, scale), progress)


def _judge(
    given: Existing, settings: Settings, again: bool, steps: StepsFrom, scale: float, progress: Progress
) -> Judged:
    """Go through the stages."""
    check_size(given.bricks, settings)
    # somebody else's colours stay: what is not owned is listed
    run = Run.of(replace(settings, owned=""), Overall(EXPECTED, progress))
    owned = PartChoice.of(settings, run.catalogue).owned
    bricks, notes = without_overlaps(moved_up(given.bricks), run.catalogue)
    if again:
        bricks, more = laid_again(run, bricks)
        notes += more
    assembly = Assembly(bricks, run.catalogue)
    with run.stage("supports"):
        own = steps == "file" and given.has_steps and not again
        plan = plan_existing(run, assembly, own_steps=own, planned=again or steps == "new")
    final = plan.final
    notes += remarks_on_plan(bricks, final.bricks, own_steps=own)
    with run.stage("stability"):
        found = check_final(run, final)
    proof = _prove(run, plan)
    run.progress.finish()
    return Judged(
        settings=settings, scale=scale, corner=np.zeros(3), left_out=given.left_out, assembly=final, stability=found,
        supports=plan, joints=(), prices=run.parts.prices, owned=owned, proof=proof,
        notes=(*given.notes, *notes, *_notes(run, found, plan, proof, owned)), timings=run.timings,
    )  # fmt: skip


def _prove(run: Run, plan: AssemblyPlan) -> Proof | None:
    """Test every building step by forces, if that is wanted."""
    if not run.settings.prove_steps:
        return None
    with run.stage("proof"):
        return run.once(prove, plan)


def _notes(run: Run, found: Stability, plan: AssemblyPlan, proof: Proof | None, owned: Owned | None) -> tuple[str, ...]:
    """Return what a user must know about bricks and building, one sentence each."""
    return (
        *remarks(plan.final, found, spare=run.settings.spare),
        *remarks_on_building(plan),
        *remarks_on_proof(proof),
        *remarks_on_owned(owned, plan.assembly),
        *remarks_on_prices(run.parts.prices, plan.final.bricks, plan.removed, run.catalogue),
    )
