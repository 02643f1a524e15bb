"""The whole way without Blender: sizes, refusals, repeatability, and meshes of every kind."""

from __future__ import annotations

import re
import threading
from dataclasses import replace

import numpy as np
import pytest
from scipy import ndimage

from legorize_addon.core import drafting
from legorize_addon.core.build import Build
from legorize_addon.core.errors import BuildError, Cancelled, LegorizeError, LimitError, MeshError, SettingsError
from legorize_addon.core.mesh.size import model_scale
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.catalogue import footprint, load_catalogue
from legorize_addon.core.model.unit_grid import COLOUR_ANY, Fill
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.presets import preset_values
from legorize_addon.core.settings import Settings
from tests.core.light import holes
from tests.core.solids import box, joined, mesh_of, moebius, reversed_mesh, sheet, sphere, tube, without
from tests.core.textured import blob, cylinder, hollow_box, painted, rgb_of, split_at_x, table, textured, torus

STAGES = [
    "mesh",
    "colours",
    "slicing",
    "trajectories",
    "unit bricks",
    "overhangs",
    "hollowing",
    "layout",
    "ties",
    "strengthening",
    "stability",
    "bracing",
    "pieces",
    "supports",
]
"""The stages in the order of the paper."""

SMALL = Settings(width=12)


def covered(build: Build) -> np.ndarray:
    """Count how many bricks cover every cell, (3 n_layers, n_y, n_x), leaving out pillars that were put in to stay."""
    parts = load_catalogue().parts
    _, _, n_y, n_x = build.grid.colour.shape
    count = np.zeros((build.grid.colour.shape[0] * 3, n_y, n_x), int)
    pillars = (build.bricks.role == Role.SUPPORT_KEPT).sum() + sum(
        len(piece.pillars) for piece in build.supports.pieces
    )
    bricks = build.bricks.take(np.arange(len(build.bricks) - pillars))
    for part, corner, turn in zip(bricks.part, bricks.corner, bricks.turn, strict=True):
        for x, y in footprint(parts[part], int(turn)):
            count[corner[2] : corner[2] + parts[part].height, corner[1] + y, corner[0] + x] += 1
    return count


def check(build: Build) -> None:
    """Check what must hold for every result."""
    hollow = build.hollow
    count = covered(build).reshape(hollow.cover.shape)
    assert count.max() == 1
    assert (count[hollow.cover == Fill.REQUIRED] == 1).all()
    assert (count[hollow.cover == Fill.EMPTY] == 0).all()
    catalogue = load_catalogue()
    assert catalogue.exists_in(build.bricks.part, build.bricks.colour).all()
    assert (build.bricks.colour >= 0).all()
    assert list(build.timings) == STAGES
    assert min(build.timings.values()) >= 0
    assert all(note.endswith(".") for note in build.notes)


# -------------------------------------------------------------- size


@pytest.mark.parametrize("n", [1, 5, 24])
def test_width_in_studs(n):
    """The longer horizontal side has the number of studs asked for."""
    build = legorize(box((0, 0, 0), (30, 20, 25)), Settings(width=n))
    assert np.ptp(build.mesh.vertices[:, 0]) == pytest.approx(8 * n)
    assert build.grid.solid.any(axis=(0, 1, 2)).sum() == n
    assert build.scale == pytest.approx(8 * n / 30)


@pytest.mark.parametrize("n", [1, 7])
def test_height_in_bricks(n):
    """The model is as many bricks high as asked for."""
    build = legorize(box((0, 0, 5), (30, 20, 25)), Settings(size_by="height", height=n))
    assert build.grid.solid.any(axis=(1, 2, 3)).tolist() == [True] * n
    assert build.scale == pytest.approx(9.6 * n / 20)


@pytest.mark.parametrize("k", [10.0, 5.0, 2.5])
def test_scale_factor_of_the_paper(k):
    """10 keeps the size of the object, 5 halves it, 2.5 quarters it."""
    mesh = box((0, 0, 0), (320, 192, 192))
    build = legorize(mesh, Settings(size_by="scale", scale=k))
    assert build.scale == k / 10
    shape = [build.grid.solid.any(axis=axes).sum() for axes in ((0, 1, 2), (0, 1, 3), (1, 2, 3))]
    assert shape == [320 / 8 * k / 10, 192 / 8 * k / 10, 192 / 9.6 * k / 10]


def test_model_points_go_back_to_the_world():
    """The corner of the grid and the scale put every brick back on the mesh as it was read."""
    mesh = box((1000, -2000, 300), (1030, -1980, 325))
    build = legorize(mesh, SMALL)
    _, _, y, x = np.nonzero(build.grid.solid)
    for axis, cells in ((0, x), (1, y)):
        low = (build.grid.origin[axis] + cells.min() * 8) / build.scale
        high = (build.grid.origin[axis] + (cells.max() + 1) * 8) / build.scale
        low_true, high_true = mesh.vertices[:, axis].min(), mesh.vertices[:, axis].max()
        assert low == pytest.approx(low_true, abs=4 / build.scale + 1e-6)
        assert high == pytest.approx(high_true, abs=4 / build.scale + 1e-6)
    assert build.grid.origin[2] / build.scale == pytest.approx(300)


# -------------------------------------------------------------- repeatability


def arrays(build: Build) -> dict[str, np.ndarray]:
    """Return all arrays of a result, by name."""
    found = {}
    for stage in ("mesh", "surface", "cut", "trajectories", "grid", "hollow", "bricks"):
        value = getattr(build, stage)
        for name in type(value).__slots__:
            each = getattr(value, name)
            for number, array in enumerate(each if isinstance(each, tuple) else [each]):
                if isinstance(array, np.ndarray):
                    found[f"{stage}.{name}.{number}"] = array
    return found


def test_two_runs_are_equal_to_the_last_bit():
    """The same mesh, settings and seed give the same arrays at every stage, and the mesh stays as it was."""
    mesh = blob(n=10, size=48)
    before = mesh.vertices.copy(), mesh.faces.copy(), mesh.uvs.copy()
    settings = Settings(width=16, colours=5, seed=3)
    first, second = arrays(legorize(mesh, settings)), arrays(legorize(mesh, settings))
    assert first.keys() == second.keys()
    for name, array in first.items():
        assert array.tobytes() == second[name].tobytes(), name
    for array, kept in zip((mesh.vertices, mesh.faces, mesh.uvs), before, strict=True):
        np.testing.assert_array_equal(array, kept)


def test_seed_changes_only_what_is_random():
    """Another seed may draw other texels; the cells stay."""
    mesh = blob(n=10, size=48)
    one, other = (legorize(mesh, Settings(width=14, colours=4, seed=seed)) for seed in (0, 1))
    np.testing.assert_array_equal(one.grid.cover, other.grid.cover)
    np.testing.assert_array_equal(one.cut.slices.heights, other.cut.slices.heights)
    check(one)
    check(other)


# -------------------------------------------------------------- progress


def test_progress_is_one_share_that_never_goes_back():
    """Every stage is told in order; the share is that of the whole run, from 0 to 1 without a step back."""
    told: list[tuple[str, float]] = []
    legorize(sphere(6, 10.0), SMALL, lambda stage, share: told.append((stage, share)))
    # loose bricks are joined within the layout, where there are any
    assert [stage for stage in dict.fromkeys(stage for stage, _ in told) if stage != "connection"] == STAGES
    shares = [share for _, share in told]
    assert shares[0] == 0
    assert shares[-1] == 1
    assert shares == sorted(shares)
    # no stage claims the whole for itself
    ends = dict(told)
    assert ends["unit bricks"] < 0.7
    assert 0 < ends["colours"] < ends["layout"] < 1


@pytest.mark.parametrize(
    ("stage", "words"), [("unit bricks", 9), ("hollowing", 5), ("stability", 4), ("supports", 20)], ids=str
)
def test_long_stages_tell_how_far_they_are(stage, words):
    """Within each stage that takes long, progress is told between the steps, so that a request to stop is heard."""
    told: list[tuple[str, float]] = []
    legorize(table(), Settings(width=24), lambda *each: told.append(each))
    shares = [share for name, share in told if name == stage]
    assert len(shares) >= words
    if stage != "stability":
        assert len(set(shares)) >= words // 2


@pytest.mark.parametrize("at", [*STAGES, None])
def test_cancelled_passes_through(at):
    """A request to stop ends the run where it is made, at the beginning of any stage, unchanged."""

    def stop(stage: str, share: float) -> None:
        if stage == at or at is None:
            raise Cancelled(f"at {stage}")

    with pytest.raises(Cancelled, match=f"^at {at or 'mesh'}$"):
        legorize(sphere(6, 10.0), SMALL, stop)


# -------------------------------------------------------------- refusals

BAD = {
    "no faces": (mesh_of(box().vertices, []), {}, MeshError, "no faces"),
    "one triangle": (mesh_of(np.eye(3), [0, 1, 2]), {}, MeshError, "only 1 triangle"),
    "not a number": (mesh_of(np.where(box().vertices == 1, np.nan, 0), box().faces), {}, MeshError, "not finite"),
    "no size": (mesh_of(box().vertices * 0, box().faces), {}, MeshError, "0 mm in size"),
    "palette": (box(), {"palette": "4, gold"}, SettingsError, "The palette names gold"),
    "height of a flat sheet": (sheet(), {"size_by": "height"}, SettingsError, "height of 0 mm"),
    "too small": (box(), {"size_by": "scale", "scale": 0.1}, SettingsError, "too small for one brick"),
    "far too small": (box(), {"size_by": "scale", "scale": 1e-4}, SettingsError, "too small for one brick"),
    "far too large": (box((0, 0, 0), (1e6, 1e6, 1e6)), {"size_by": "scale"}, LimitError, "choose a scale of 0.0"),
    "beyond all bounds": (
        box((0, 0, 0), (1e11, 1e11, 1e11)), {"size_by": "scale", "scale": 1e6}, LimitError, "choose a scale of"
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_refused_in_one_sentence(name):
    """What cannot be built is refused with a sentence that says what and why."""
    mesh, options, kind, words = BAD[name]
    with pytest.raises(LegorizeError, match=words) as refusal:
        legorize(mesh, Settings(**options))
    assert type(refusal.value) is kind
    sentence = str(refusal.value)
    assert sentence.endswith(".")
    assert "\n" not in sentence
    assert ". " not in sentence


def test_size_is_checked_before_the_work():
    """What is too large is refused before any stage begins."""
    told: list[str] = []
    with pytest.raises(LimitError, match="choose a height of 62 or less, or raise limit_size to 480"):
        legorize(box((0, 0, 0), (1, 1, 8)), Settings(size_by="height", height=500, limit_size=60), told.append)
    assert told == []


def test_end_of_the_memory_is_a_sentence():
    """Whichever stage asks for more memory than there is, the user learns what to do."""

    def greedy(stage: str, share: float) -> None:
        if stage == "layout":
            np.empty(1 << 62, dtype=np.uint8)

    with pytest.raises(BuildError, match=r"^There is not enough memory .*: choose a smaller size.*\.$") as refusal:
        legorize(sphere(6, 10.0), SMALL, greedy)
    assert isinstance(refusal.value.__cause__, MemoryError)


def test_extent_that_is_missing_is_told():
    """A needle without width cannot have a width in studs."""
    upright = mesh_of(np.zeros((20, 3)), sheet().faces)
    upright.vertices[:, 2] = np.arange(20)
    with pytest.raises(SettingsError, match=r"^The mesh has a width of 0 mm: .*\.$"):
        model_scale(upright, size_by="width", width=48, height=19, scale=10.0, cm=9.0)
    assert model_scale(upright, size_by="height", width=48, height=19, scale=10.0, cm=9.0) == pytest.approx(9.6)


# -------------------------------------------------------------- meshes of every kind


def images_of_many_kinds() -> TriangleMesh:
    """Make a box with three images: plain, repeated stripes, and clamped."""
    mesh = box((0, 0, 0), (96, 96, 96))
    stripes = np.repeat(rgb_of([4, 1]), 4, axis=0)[None].repeat(2, axis=0)
    return replace(
        mesh,
        uvs=mesh.vertices[mesh.faces][..., [0, 2]] / 24,
        face_image=(np.arange(12) // 4).astype(np.int32),
        images=(rgb_of([14])[None], stripes, rgb_of([2, 15])[None]),
        image_clamp=np.array([False, False, True]),
    )


KINDS = {
    "box": box(),
    "ball": sphere(8),
    "torus": torus(),
    "table": table(),
    "cylinder in two colours": split_at_x(cylinder()),
    "blob": blob(n=8, size=32),
    "box with a cavity": hollow_box(((0, 0, 0), (60, 60, 60)), ((20, 20, 20), (40, 40, 40))),
    "inside out": reversed_mesh(sphere(8)),
    "open cup": without(box((0, 0, 0), (48, 48, 48)), 2, 3),
    "flat sheet": sheet(),
    "standing sheet": mesh_of(sheet().vertices[:, [0, 2, 1]], sheet().faces),
    "wavy sheet": sheet(12, 12, lambda x, y: 0.2 * np.sin(6 * x) * np.cos(5 * y)),
    "moebius": moebius(),
    "overlapping": joined(box((0, 0, 0), (40, 40, 40)), box((20, 20, 20), (60, 60, 60))),
    "apart": joined(box((0, 0, 0), (40, 40, 40)), box((80, 0, 60), (120, 40, 100))),
    "several images": images_of_many_kinds(),
    "far away": mesh_of(sphere(8).vertices + 1e6, sphere(8).faces),
    "below the ground": mesh_of(sphere(8).vertices - 50, sphere(8).faces),
}


@pytest.mark.parametrize("name", KINDS)
def test_meshes_of_every_kind_are_built(name):
    """Each cell that must be covered is, once, by a brick that is made in its colour; nothing lies elsewhere."""
    build = legorize(KINDS[name], SMALL)
    assert len(build.bricks) > 0
    check(build)


@pytest.mark.parametrize(
    "options",
    [
        {"cell_colour": "longest"},
        {"sampling": "image"},
        {"one_to_one": True},
        {"hollow": False},
        {"shell": 2},
        {"keep_thin": False},
        {"symmetric": False},
        {"cusp": 9.6, "chord_deviation": 1.0},
        {"colours": 1},
        preset_values("paper"),
    ],
    ids=str,
)
def test_settings_of_every_kind_are_built(options):
    """Whatever is chosen, the result holds together as a result."""
    build = legorize(blob(n=8, size=32), Settings(**{"width": 14, **options}))
    check(build)
    assert build.settings.width == 14


def test_the_published_way_tells_its_four_steps():
    """A sentence for each step of the paper's framework, with how much and how long; a default build has none."""
    mesh = blob(n=8, size=32)
    build = legorize(mesh, Settings(**preset_values("paper") | {"width": 8}))
    steps = [note for note in build.notes if note.startswith("Step ")]
    needed = (build.hollow.cover == Fill.REQUIRED).sum()
    assert re.match(rf"Step 1, example preparation: {needed:,} cells of .* machine: 1500, of which 500 best", steps[0])
    assert re.match(r"Step 2, feature extraction: 4 energies of [\d,]+ simulated fills", steps[1])
    assert re.match(r"Step 3, classification model: C 8.0, gamma 2.0, [\d,]+ support vectors, 5 folds", steps[2])
    decisions = [
        int(number.replace(",", "")) for number in re.findall(r"([\d,]*\d) (?:decisions|best|good|poor)", steps[3])
    ]
    assert decisions[0] == sum(decisions[1:]) > 0
    assert all(re.search(r", \d+\.\d s[.;]", step) for step in steps)
    assert len(steps) == 4
    assert not [note for note in legorize(mesh, Settings(width=8)).notes if note.startswith("Step ")]


def test_palette_of_one_colour():
    """With red alone, all bricks are red."""
    build = legorize(blob(n=8, size=32), Settings(width=12, palette="4"))
    check(build)
    assert set(build.bricks.colour.tolist()) == {4}
    assert set(build.surface.codes.tolist()) == {4}


def test_one_to_one_never_asks_for_more_colours_than_there_are():
    """With a palette of three, one to one finds three dominant colours and uses each."""
    build = legorize(blob(n=8, size=32), Settings(width=12, palette="0,4,15", one_to_one=True))
    assert sorted(build.surface.codes.tolist()) == [0, 4, 15]


def test_several_images_colour_their_faces():
    """Faces of each image take its colours, repeated or clamped as it says."""
    build = legorize(images_of_many_kinds(), SMALL)
    assert {14, 4, 1, 2, 15} <= set(np.unique(build.grid.colour).tolist())


def test_flat_sheet_becomes_one_layer_without_holes():
    """A sheet without thickness is one layer of bricks in its full size."""
    build = legorize(sheet(), Settings(width=16))
    solid = build.grid.solid[:, 0]
    assert len(solid) == 1
    assert solid.sum() >= 15 * 15


def test_smallest_model_is_one_brick():
    """A box of half a stud's cube, rounded up, is one brick; hidden colours are free, this one is seen."""
    build = legorize(painted(box(), 4), Settings(width=1))
    check(build)
    assert len(build.bricks) == 1
    assert build.bricks.colour.tolist() == [4]


def test_open_mesh_keeps_its_walls_and_is_told():
    """A box without its top keeps its floor and every cell of its walls, and the user is told where it is open."""
    mesh = box((0, 0, 0), (48, 48, 48))
    top = np.flatnonzero((mesh.vertices[mesh.faces][..., 2] == 48).all(axis=1))
    build = legorize(without(mesh, *top), Settings(width=6))
    solid = build.grid.solid[:, 0, 1:-1, 1:-1]
    assert solid.shape == (5, 6, 6)
    walls = np.ones((6, 6), bool)
    walls[1:-1, 1:-1] = False
    assert solid[:, walls].all()
    assert solid[0].all()
    assert any("open along 4 edges" in note for note in build.notes)


def test_floating_part_is_told():
    """A body in the air is told, and gets a pillar unless none is wanted; one piece is not complained about."""
    build = legorize(KINDS["apart"], Settings(width=15, supports="none"))
    assert any("in the air" in note for note in build.notes)
    carried = legorize(KINDS["apart"], Settings(width=15))
    assert carried.graph.n_floating == 0
    assert any("stay in the model" in note or "stays in the model" in note for note in carried.notes)
    assert legorize(box(), SMALL).notes == ()


def lattice(cells) -> np.ndarray:
    """Put the plates of a grid one above the other."""
    return cells.reshape(-1, *cells.shape[2:])


@pytest.mark.parametrize("plates", ["none", "pays", "all"])
@pytest.mark.parametrize("kind", ["ball", "torus", "table", "blob", "open cup", "box with a cavity"])
def test_no_hole_shows_the_inside(kind, plates):
    """From 26 directions no light meets a hollowed-out cell before a brick, and all that must stay is joined."""
    build = legorize(KINDS[kind], Settings(width=20, plates=plates))
    solid, required, built = (
        lattice(cells) for cells in (build.grid.solid, build.hollow.cover == Fill.REQUIRED, build.hollow.solid)
    )
    assert holes(solid, required) == 0
    # every cell that must be built reaches the ground through cells that must or may be
    label, _ = ndimage.label(built)
    whole, _ = ndimage.label(solid | built)
    lowest = np.unique(label[0][label[0] > 0])
    grounded = np.isin(label, lowest)
    reachable = np.isin(whole, np.unique(whole[0][whole[0] > 0]))
    assert (grounded | ~required | ~reachable).all()


def test_cavities_and_tunnels_stay():
    """The tunnel of a tube and the cavity of a box are nowhere filled."""
    cavity = legorize(KINDS["box with a cavity"], Settings(width=24))
    middle = cavity.grid.solid.shape
    inner = lattice(cavity.hollow.solid)[middle[0] * 3 // 2 - 6 : middle[0] * 3 // 2 + 6]
    centre = inner[:, middle[2] // 2 - 3 : middle[2] // 2 + 3, middle[3] // 2 - 3 : middle[3] // 2 + 3]
    assert not centre.any()
    pipe = legorize(tube(80.0, 56.0, 96.0), Settings(width=20))
    y, x = (np.arange(n) - (n - 1) / 2 for n in pipe.grid.solid.shape[2:])
    tunnel = np.hypot(y[:, None], x) * 8 < 52.0
    assert not lattice(pipe.hollow.solid)[:, tunnel].any()


def test_hollow_leaves_the_inside_empty():
    """A solid block loses its inside and keeps its shell; hidden cells of the shell take any colour."""
    full = legorize(box(), Settings(width=12, hollow=False))
    empty = legorize(box(), Settings(width=12))
    assert (full.hollow.cover == full.grid.cover).all()
    assert (empty.hollow.cover == Fill.EMPTY).sum() > (full.hollow.cover == Fill.EMPTY).sum()
    seen = empty.grid.colour > COLOUR_ANY
    assert (empty.hollow.cover[seen] == Fill.REQUIRED).all()


def test_every_texel_counts_as_it_was_read():
    """Sampled by image, one texel among 260,000 that reduced images swallow is a dominant colour all the same."""
    image = np.full((512, 512, 3), 255, np.uint8)
    image[300, 200] = (200, 0, 0)
    mesh = textured(box((0, 0, 0), (40, 40, 40)), image)
    small = Settings(width=4, sampling="image", supports="none")
    assert legorize(mesh, small).surface.centres.tolist() == [[200, 0, 0], [255, 255, 255]]
    assert [200, 0, 0] not in legorize(mesh, replace(small, sampling="surface")).surface.centres.tolist()


def test_progress_is_told_while_a_stage_is_silent(monkeypatch):
    """A stage that says nothing until it was told of three times more ends, as it is told of again and again."""
    heard: list[tuple[str, float]] = []
    enough = threading.Event()

    def hear(stage: str, share: float) -> None:
        heard.append((stage, share))
        if heard[-3:] == [heard[-1]] * 3 and stage == "overhangs":
            enough.set()

    silent = drafting.close_overhangs
    monkeypatch.setattr(drafting, "close_overhangs", lambda *args, **kw: enough.wait(60) and silent(*args, **kw))
    assert len(legorize(box((0, 0, 0), (40, 40, 40)), SMALL, hear).bricks)
    assert [share for _, share in heard] == sorted(share for _, share in heard)
