"""The stages in order: the one place that knows it."""

from __future__ import annotations

from functools import partial

from .build import Build
from .building import Proof, prove_steps
from .errors import enough_memory
from .estimate import COUNTED, check_limits, estimate
from .fitting import fit
from .layout import recolour_visible
from .layout.joining import add_ties
from .mesh import TriangleMesh
from .model import Assembly, contact_graph
from .native import watched
from .progress import Overall, Progress, silent
from .report import remarks, remarks_on_building, remarks_on_prices, remarks_on_proof, remarks_on_split
from .settings import Settings
from .shell import make_cohesive
from .slicing import fit_grid, link_loops
from .stages import (
    Run,
    brace,
    carry,
    check_stability,
    close_overhangs,
    cut_mesh,
    find_colours,
    hollow_out,
    lay_bricks,
    make_plan,
    make_unit_grid,
    prepare_mesh,
    strengthen_joints,
)
from .statics import Stability, stability
from .supports import AssemblyPlan, segment
from .unit_bricks import remarks_on_dithering


@enough_memory()
def legorize(mesh: TriangleMesh, settings: Settings, progress: Progress = silent) -> Build:
    """Turn a textured mesh into a brick model.

    Parameters
    ----------
    mesh : TriangleMesh
        As read, in world mm.
    settings : Settings
    progress : Progress
        Called at least once a second with the current stage, or its current part, and the share of the whole run that
        is done, which never decreases.

    Returns
    -------
    Build

    Raises
    ------
    LegorizeError
        The mesh or the settings cannot be used, in one sentence.
    """
    if settings.size_by in COUNTED:
        return watched(partial(fit, mesh, settings, _legorize), progress)
    return watched(partial(_legorize, mesh, settings), progress)


def _legorize(mesh: TriangleMesh, settings: Settings, progress: Progress) -> Build:
    """Go through the stages."""
    expected = estimate(mesh, settings)
    check_limits(expected, settings)
    run = Run.of(settings, Overall(expected.stages, progress))
    plates, given = settings.plates != "none", mesh
    with run.stage("mesh"):
        mesh, repairs, turn, scale, unseen = prepare_mesh(run, mesh)
    with run.stage("colours"):
        surface = find_colours(run, mesh, given)
    with run.stage("slicing"):
        frame = fit_grid(mesh, symmetric=settings.symmetric, plates=plates)
        cut = cut_mesh(run, mesh, surface, frame)
    with run.stage("trajectories"):
        trajectories = link_loops(mesh, cut.slices, surface, chord_deviation=settings.chord_deviation)
    with run.stage("unit bricks"):
        grid = make_unit_grid(run, mesh, repairs, trajectories, surface, frame, cut)
    with run.stage("overhangs"):
        grid, offsets = close_overhangs(run, grid)
    with run.stage("hollowing"):
        shell = make_cohesive(hollow_out(run, grid), plates=plates)
    with run.stage("layout"):
        bricks, shell = lay_bricks(run, shell)
    with run.stage("ties"):
        bricks, shell = add_ties(bricks, shell, run.catalogue, plates=plates)
    with run.stage("strengthening"):
        bricks, shell, forces = strengthen_joints(run, bricks, shell)
        bricks = recolour_visible(bricks, shell, contact_graph(bricks, run.catalogue), run.catalogue)
    with run.stage("stability"):
        assembly = carry(run, Assembly(bricks, run.catalogue))
        found = check_stability(run, assembly, forces if len(assembly) == len(bricks) else None)
    with run.stage("bracing"):
        assembly, found = brace(run, assembly, found)
    with run.stage("pieces"):
        assembly, joints = segment(assembly, most=settings.split, deepest=settings.hanging)
    with run.stage("supports"):
        plan = make_plan(run, assembly)
    if len(plan.final) > len(assembly):
        with run.stage("stability again"):
            found = stability(plan.final, clutch=settings.clutch, progress=run.progress)
    proof = None
    if settings.prove_steps:
        with run.stage("proof"):
            proof = prove_steps(plan.steps, plan.assembly, clutch=settings.clutch, progress=run.progress)
    run.progress.finish()
    notes = (*repairs.sentences(), *unseen, *_notes(run, mesh, found, plan, proof))
    return Build(
        settings=settings, mesh=mesh, repairs=repairs, scale=scale, turn=turn, surface=surface, cut=cut,
        trajectories=trajectories, offsets=offsets, grid=grid, hollow=shell, assembly=plan.final, stability=found,
        supports=plan, joints=joints, prices=run.parts.prices, proof=proof, notes=notes, timings=run.timings,
    )  # fmt: skip


def _notes(run: Run, mesh: TriangleMesh, found: Stability, plan: AssemblyPlan, proof: Proof | None) -> tuple[str, ...]:
    """Return what a user must know about bricks and building, one sentence each."""
    assembly = plan.final
    return (
        *remarks_on_dithering(mesh, run.settings.dithering),
        *remarks(assembly, found, spare=run.settings.spare),
        *remarks_on_building(plan),
        *remarks_on_split(plan, most=run.settings.split),
        *remarks_on_proof(proof),
        *remarks_on_prices(run.parts.prices, assembly.bricks, plan.removed, run.catalogue),
    )
