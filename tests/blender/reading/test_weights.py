"""Painted weights: vertex groups and attributes of points, through modifiers, instances, baking and several objects."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.reading import read_objects, weight_names
from legorize_addon.reading.importers import load
from tests.blender.builders import Nodes


def read_weighted(*objects: bpy.types.Object, name: str = "face") -> TriangleMesh:
    """Read objects with their weights."""
    mesh, _ = read_objects(objects, bpy.context.evaluated_depsgraph_get(), weight=name)
    return mesh


def cube() -> bpy.types.Object:
    """Add a cube of two units."""
    bpy.ops.mesh.primitive_cube_add(size=2)
    return bpy.context.object


def in_group(obj: bpy.types.Object, name: str = "face") -> bpy.types.Object:
    """Paint a vertex group: 1 where x is 1, .25 where x is -1 and y is 1, and nothing at the others."""
    bpy.context.view_layer.update()
    for value, rows in ((1.0, lambda co: co.x > 0), (0.25, lambda co: co.x < 0 < co.y)):
        group = obj.vertex_groups.get(name) or obj.vertex_groups.new(name=name)
        group.add([vertex.index for vertex in obj.data.vertices if rows(vertex.co)], value, "REPLACE")
    return obj


def with_attribute(
    obj: bpy.types.Object, kind: str, values: list[float], domain: str = "POINT", name: str = "face"
) -> bpy.types.Object:
    """Give a mesh an attribute."""
    attribute = obj.data.attributes.new(name, kind, domain)
    attribute.data.foreach_set("value", values)
    return obj


def expected(mesh: TriangleMesh) -> np.ndarray:
    """Return what :func:`in_group` paints at the places of a cube's corners."""
    x, y, _ = (mesh.vertices / 1000).T
    return np.select([x > 0.5, y > 0.5], [1.0, 0.25], 0.0)


def test_a_vertex_group_is_read() -> None:
    """Each vertex has its weight, 0 where it is not in the group; others of the object's groups do not matter."""
    obj = cube()
    obj.vertex_groups.new(name="other").add(list(range(8)), 0.5, "REPLACE")
    mesh = read_weighted(in_group(obj))
    np.testing.assert_allclose(mesh.weight, expected(mesh))


@pytest.mark.parametrize("kind", ["FLOAT", "INT", "INT8", "BOOLEAN"])
def test_an_attribute_of_points_is_read(kind: str) -> None:
    """Of any kind with one number."""
    values = [0, 1, 0, 1, 1, 0, 0, 1]
    np.testing.assert_array_equal(read_weighted(with_attribute(cube(), kind, values)).weight, values)


def test_modifiers_count() -> None:
    """A subdivided and mirrored object has the weights of its new vertices; those between have what is between."""
    obj = in_group(cube())
    obj.modifiers.new("divide", "SUBSURF").subdivision_type = "SIMPLE"
    mirror = obj.modifiers.new("mirror", "MIRROR")
    mirror.use_axis = (False, False, True)
    mirror.use_mirror_vertex_groups = False
    mesh = read_weighted(obj)
    x, y = mesh.vertices[:, 0] / 1000, mesh.vertices[:, 1] / 1000
    assert len(mesh.vertices) > 26
    np.testing.assert_allclose(mesh.weight, (1 + x) / 2 + (1 - x) / 2 * (1 + y) / 2 * 0.25, atol=1e-6)


def test_several_objects_and_instances_come_together() -> None:
    """An object without the weight counts as elsewhere; a mirrored one keeps its weights at its places."""
    painted, plain, mirrored = in_group(cube()), cube(), in_group(cube())
    plain.location.x, mirrored.location.x = 10, 20
    mirrored.scale.x = -1
    mesh = read_weighted(painted, plain, mirrored)
    x, y, _ = (mesh.vertices / 1000).T
    np.testing.assert_allclose(mesh.weight[x < 5], np.select([x > 0, y > 0], [1.0, 0.25], 0.0)[x < 5])
    assert (mesh.weight[(x > 5) & (x < 15)] == 0).all()
    np.testing.assert_allclose(mesh.weight[x > 15], np.select([x < 20, y > 0], [1.0, 0.25], 0.0)[x > 15])


def test_baked_objects_keep_their_weights() -> None:
    """Colours made by nodes are baked to an image; the vertices keep what was painted."""
    obj, nodes = in_group(cube()), Nodes()
    obj.data.materials.append(nodes.colour(nodes.add("TexChecker").outputs["Color"]))
    mesh = read_weighted(obj)
    assert max(image.size for image in mesh.images) > 3
    np.testing.assert_allclose(mesh.weight, expected(mesh))


def test_without_a_name_nothing_is_read() -> None:
    """The weight of a model that asks for none is none."""
    assert read_weighted(in_group(cube()), name="").weight is None


def refusal(*objects: bpy.types.Object, name: str = "face") -> str:
    """Return the sentence with which a weight is refused."""
    with pytest.raises(SettingsError) as refused:
        read_weighted(*objects, name=name)
    return str(refused.value)


def test_bad_names_and_values_are_refused_in_one_sentence() -> None:
    """A name that nothing has, with those that there are; values beyond 0 to 1 or not finite; other attributes."""
    assert (
        refusal(cube()) == "weight is 'face', but no vertex group or attribute of points has that name: there is none."
    )
    named = with_attribute(in_group(cube(), "eyes"), "FLOAT", [0.0] * 8, name="nose")
    assert refusal(named).endswith("has that name: there are 'eyes', 'nose'.")
    wide = with_attribute(cube(), "FLOAT", [0, 0.5, -1, 7, 0, 0, 0, 0])
    assert refusal(wide) == f"weight is 'face', which goes from -1 to 7 on {wide.name!r}: use values from 0 to 1."
    endless = with_attribute(cube(), "FLOAT", [0, 0, 0, np.inf, np.nan, 0, 0, 0])
    assert "no finite number on 2 vertices" in refusal(endless)
    of_faces = with_attribute(cube(), "FLOAT", [0.0] * 6, "FACE")
    assert "does not have one number for each point" in refusal(of_faces)


def test_rounding_of_modifiers_is_no_bad_value() -> None:
    """A hair beyond 0 and 1 becomes 0 and 1."""
    values = [0, 1.000001, -0.000001, 1, 0, 0, 0, 0]
    found = read_weighted(with_attribute(cube(), "FLOAT", values)).weight
    assert (found.min(), found.max()) == (0, 1)


def test_the_names_to_choose_from() -> None:
    """Groups and attributes of points with one number, each once, and none of Blender's own."""
    one, other = in_group(cube(), "eyes"), in_group(cube(), "ears")
    with_attribute(one, "FLOAT", [0.0] * 8, name="nose")
    with_attribute(one, "FLOAT", [0.0] * 6, "FACE", name="faces")
    in_group(other, "eyes")
    bpy.ops.object.light_add()
    assert weight_names([one, other, bpy.context.object]) == ["ears", "eyes", "nose"]
    assert weight_names([]) == []


@pytest.mark.parametrize("suffix", ["glb", "ply"])
def test_files_bring_their_attributes(tmp_path: Path, suffix: str) -> None:
    """An attribute of points goes through a glTF file, where its name begins with a bar, and through a PLY file."""
    name = {"glb": "_FACE", "ply": "face"}[suffix]
    with_attribute(cube(), "FLOAT", [0, 0.5, 1, 0, 0, 0.25, 0, 0], name=name)
    path = tmp_path / f"cube.{suffix}"
    if suffix == "glb":
        bpy.ops.export_scene.gltf(filepath=str(path), export_attributes=True)
    else:
        bpy.ops.wm.ply_export(filepath=str(path), export_attributes=True)
    mesh = read_weighted(*load(path).objects, name=name)
    # the corner at (-1, 1, -1) has 1, whatever the file's axes are
    heavy = np.unique(np.sign(mesh.vertices[mesh.weight == 1]), axis=0)
    assert heavy.shape == (1, 3)
    assert sorted(np.unique(mesh.weight).tolist()) == [0, 0.25, 0.5, 1]
