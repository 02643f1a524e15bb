"""The bundled sample: what it promises, and that making it again gives the same."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

bpy = pytest.importorskip("bpy", reason="needs Blender as a Python module")

ROOT = Path(__file__).parents[2]
SAMPLE = ROOT / "assets" / "sample.glb"
WIDTH = 48


@dataclass(frozen=True, slots=True, eq=False)
class Rooster:
    """An imported sample: its object, and places (n_v, 3) in metres, faces (n_f, 3), colours (n_f, 3) in [0, 255]."""

    object: bpy.types.Object
    image: bpy.types.Image
    places: np.ndarray
    faces: np.ndarray
    colours: np.ndarray

    @property
    def stud(self) -> float:
        """Size of a stud in metres when the model is 48 studs long."""
        return float(np.ptp(self.places[:, :2], axis=0).max() / WIDTH)

    @property
    def middles(self) -> np.ndarray:
        """Middle of each face."""
        return self.places[self.faces].mean(axis=1)


def load(path: Path) -> Rooster:
    """Import a sample as a user would; vertices at the same place, along texture seams, become one."""
    known = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=str(path))
    (found,) = [entry for entry in set(bpy.data.objects) - known if entry.type == "MESH"]
    places, corner = np.empty(len(found.data.vertices) * 3, np.float32), np.empty(len(found.data.loops), np.int32)
    found.data.vertices.foreach_get("co", places)
    found.data.loops.foreach_get("vertex_index", corner)
    unique, same = np.unique(places.reshape(-1, 3).astype(np.float64), axis=0, return_inverse=True)
    image = base_colour(found)
    return Rooster(found, image, unique, same.ravel()[corner].reshape(-1, 3), middle_colours(found, image))


def base_colour(found: bpy.types.Object) -> bpy.types.Image:
    """Return the image that is the base colour of an object's one material."""
    (material,) = found.data.materials
    (node,) = [entry for entry in material.node_tree.nodes if entry.type == "TEX_IMAGE"]
    assert node.outputs["Color"].links[0].to_socket.name == "Base Color"
    return node.image


def middle_colours(found: bpy.types.Object, image: bpy.types.Image) -> np.ndarray:
    """Return the colour of the texel in the middle of every face, (n_f, 3) in [0, 255]."""
    width, height = image.size
    pixels = np.array(image.pixels[:], dtype=np.float64).reshape(height, width, 4)
    uvs = np.empty(len(found.data.loops) * 2, dtype=np.float32)
    found.data.uv_layers[0].data.foreach_get("uv", uvs)
    column, row = (uvs.reshape(-1, 3, 2).mean(axis=1) * [width, height]).astype(int).T
    return np.round(pixels[row, column, :3] * 255)


@pytest.fixture
def rooster() -> Rooster:
    """Return the bundled sample in an empty scene."""
    return load(SAMPLE)


def test_the_file_is_small_and_holds_its_texture(rooster: Rooster) -> None:
    """One file below 1.5 MB holds the mesh, its UV map and its packed image, and no vertex colours."""
    assert SAMPLE.stat().st_size < 1_500_000
    assert rooster.image.packed_file is not None
    assert len(rooster.object.data.uv_layers) == 1
    assert len(rooster.object.data.color_attributes) == 0


def test_it_is_as_large_as_a_rooster(rooster: Rooster) -> None:
    """Unscaled and unturned it measures 20 to 60 cm each way and stands on z = 0."""
    assert np.allclose(rooster.object.matrix_world, np.eye(4))
    assert rooster.places[:, 2].min() == 0
    assert np.all((np.ptp(rooster.places, axis=0) > 0.2) & (np.ptp(rooster.places, axis=0) < 0.6))


def test_its_weight_is_above_its_legs(rooster: Rooster) -> None:
    """A hollow rooster's centre of gravity lies less than a stud before or behind the shins."""
    sides = np.diff(rooster.places[rooster.faces], axis=1)
    area = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    centre = np.average(rooster.middles, axis=0, weights=area)
    shins = rooster.places[np.abs(rooster.places[:, 2] - 0.06) < 0.01]
    assert np.allclose(centre[:2], shins[:, :2].mean(axis=0), atol=rooster.stud)


def test_the_surface_is_closed(rooster: Rooster) -> None:
    """Of 4,000 to 20,000 triangles each two neighbours run along their edge in opposite directions."""
    faces = rooster.faces
    assert 4_000 <= len(faces) <= 20_000
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    once = np.unique(edges, axis=0)
    assert len(once) == len(edges)
    assert np.array_equal(once, np.unique(edges[:, ::-1], axis=0))


def test_a_cavity_lies_in_the_body(rooster: Rooster) -> None:
    """There are two closed surfaces without handles: a body, and turned inwards a cavity of more than a tenth of it."""
    faces = rooster.faces
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    count = len(rooster.places)
    n_bodies, body = connected_components(coo_array((np.ones(len(edges)), tuple(edges.T)), shape=(count, count)))
    first, second, third = np.moveaxis(rooster.places[faces], 1, 0)
    parts = np.einsum("ni,ni->n", first, np.cross(second, third)) / 6
    volume = np.bincount(body[faces[:, 0]], parts)
    euler = np.bincount(body) - np.bincount(body[faces[:, 0]]) / 2
    assert n_bodies == 2
    assert np.array_equal(euler, [2, 2])
    assert volume.min() < -volume.max() / 10


def test_left_mirrors_right(rooster: Rooster) -> None:
    """Every vertex has its mirror image, so that the bricks can be symmetric."""
    places = np.round(rooster.places, 5)
    assert np.array_equal(np.unique(places, axis=0), np.unique(places * [-1, 1, 1] + 0.0, axis=0))


def test_thin_legs_carry_an_overhanging_head_and_tail(rooster: Rooster) -> None:
    """At 48 studs a leg is two to four studs thick, and beak and tail reach twelve studs past the feet."""
    places, stud = rooster.places, rooster.stud
    shin = np.ptp(places[(np.abs(places[:, 2] - 0.06) < 0.01) & (places[:, 0] > 0), :2], axis=0)
    feet = places[places[:, 2] < 0.02, 1]
    assert np.all((shin > 2 * stud) & (shin < 4 * stud))
    assert places[:, 1].min() < feet.min() - 12 * stud
    assert places[:, 1].max() > feet.max() + 12 * stud


def test_many_colours_are_seen(rooster: Rooster) -> None:
    """Eight colours, each at least 60 of 255 away from the others, each colour at least a hundredth of the faces."""
    colours, count = np.unique(rooster.colours, axis=0, return_counts=True)
    distinct: list[np.ndarray] = []
    for colour in colours[count >= count.sum() / 100]:
        if all(np.linalg.norm(colour - other) > 60 for other in distinct):
            distinct.append(colour)
    assert len(distinct) >= 8


def test_left_is_painted_like_right(rooster: Rooster) -> None:
    """Faces that mirror each other have the same colour, wherever their texels lie in the image."""
    colours = dict(zip(map(tuple, np.round(rooster.middles, 5)), rooster.colours, strict=True))
    mirrored = [(colour, colours.get((0.0 - x, y, z))) for (x, y, z), colour in colours.items()]
    same = [np.array_equal(here, there) for here, there in mirrored if there is not None]
    assert len(same) > len(mirrored) / 2
    assert np.mean(same) > 0.95


def test_making_it_again_gives_the_same(rooster: Rooster, tmp_path: Path) -> None:
    """The script, run as a user would, makes the same shape with the same colours on it."""
    subprocess.run(
        [sys.executable, ROOT / "scripts" / "research" / "make_samples.py", tmp_path / "again.glb"], check=True
    )
    again = load(tmp_path / "again.glb")
    assert np.allclose(again.places, rooster.places, atol=2e-6)
    assert np.array_equal(again.faces, rooster.faces)
    assert np.mean(np.all(again.colours == rooster.colours, axis=1)) > 0.99
