"""Objects, images and materials for the tests that read them, and how to look at what was read."""

from __future__ import annotations

import bpy
import numpy as np

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.reading.objects import read_objects

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
QUAD_UVS = [(0, 0), (1, 0), (1, 1), (0, 1)]
# bottom row red, green; top row blue, white; then one column more so that width and height differ
TEXELS = np.array(
    [[(200, 10, 20), (30, 180, 40), (9, 9, 9)], [(50, 60, 210), (250, 240, 230), (90, 90, 90)]], dtype=np.uint8
)


def add_object(mesh: bpy.types.Mesh, name: str = "thing") -> bpy.types.Object:
    """Put a mesh into the scene."""
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def add_quad(material: bpy.types.Material | None = None, uvs: list[tuple[float, float]] | None = QUAD_UVS):
    """Add a unit square in the plane z = 0 with one UV map."""
    mesh = bpy.data.meshes.new("quad")
    mesh.from_pydata(CORNERS, [], [(0, 1, 2, 3)])
    if uvs is not None:
        mesh.uv_layers.new(name="first").uv.foreach_set("vector", np.array(uvs, dtype=np.float32).ravel())
    if material is not None:
        mesh.materials.append(material)
    return add_object(mesh)


def add_image(texels: np.ndarray = TEXELS, alpha: np.ndarray | None = None, *, data: bool = False) -> bpy.types.Image:
    """Add an image of sRGB bytes, or of values if they are floats."""
    height, width = texels.shape[:2]
    image = bpy.data.images.new("image", width, height, alpha=True, float_buffer=texels.dtype != np.uint8, is_data=data)
    pixels = np.ones((height, width, 4), dtype=np.float32)
    pixels[..., :3] = texels / 255 if texels.dtype == np.uint8 else texels
    if alpha is not None:
        pixels[..., 3] = alpha
    image.pixels.foreach_set(pixels.ravel())
    return image


class Nodes:
    """A material under construction: a Principled shader, and nodes to be linked to it."""

    def __init__(self) -> None:
        self.material = bpy.data.materials.new("paint")
        if bpy.app.version < (5, 0, 0):
            self.material.use_nodes = True
        self.tree = self.material.node_tree
        self.shader = self.tree.nodes["Principled BSDF"]
        self.output = self.tree.nodes["Material Output"]

    def add(self, kind: str, **properties):
        """Add a node and set its properties."""
        node = self.tree.nodes.new("ShaderNode" + kind)
        for name, value in properties.items():
            setattr(node, name, value)
        return node

    def link(self, source, target) -> None:
        """Link an output to an input."""
        self.tree.links.new(source, target)

    def colour(self, output) -> bpy.types.Material:
        """Link an output to the base colour; return the material."""
        self.link(output, self.shader.inputs["Base Color"])
        return self.material


def image_material(image: bpy.types.Image, **properties) -> bpy.types.Material:
    """Return a material with an image."""
    nodes = Nodes()
    return nodes.colour(nodes.add("TexImage", image=image, **properties).outputs["Color"])


def multiplied(nodes: Nodes, first, second, factor: float = 1.0):
    """Multiply two outputs, or an output and a colour; return the result."""
    mix = nodes.add("Mix", data_type="RGBA", blend_type="MULTIPLY")
    share, one, two = (
        next(socket for socket in mix.inputs if socket.identifier == name)
        for name in ("Factor_Float", "A_Color", "B_Color")
    )
    share.default_value = factor
    nodes.link(first, one)
    if isinstance(second, tuple):
        two.default_value = second
    else:
        nodes.link(second, two)
    return next(socket for socket in mix.outputs if socket.identifier == "Result_Color")


def read(*objects: bpy.types.Object) -> TriangleMesh:
    """Read objects without remarks."""
    mesh, remarks = read_with_remarks(*objects)
    assert remarks == ()
    return mesh


def read_with_remarks(*objects: bpy.types.Object) -> tuple[TriangleMesh, tuple[str, ...]]:
    """Read objects."""
    return read_objects(objects, bpy.context.evaluated_depsgraph_get())


def colours_at(mesh: TriangleMesh, points: np.ndarray) -> np.ndarray:
    """Return the sRGB bytes at points in the plane z = 0, in Blender units."""
    found = np.full((len(points), 3), -1)
    for face, corners in enumerate(mesh.vertices[mesh.faces] / 1000):
        edges = np.column_stack([corners[1] - corners[0], corners[2] - corners[0]])[:2]
        along = np.linalg.solve(edges, (points - corners[0, :2]).T).T
        weights = np.column_stack([1 - along.sum(axis=1), along])
        inside = (weights > -1e-9).all(axis=1)
        image, clamp = mesh.images[mesh.face_image[face]], mesh.image_clamp[mesh.face_image[face]]
        size = np.array([image.shape[1], image.shape[0]])
        texel = np.floor(weights @ mesh.uvs[face] * size).astype(int)
        texel = np.clip(texel, 0, size - 1) if clamp else texel % size
        found[inside] = image[texel[inside, 1], texel[inside, 0]]
    assert (found >= 0).all()
    return found


def texel_centres(texels: np.ndarray = TEXELS) -> np.ndarray:
    """Return the centres of the texels of an image that fills the unit square, row by row from below."""
    height, width = texels.shape[:2]
    x, y = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    return np.column_stack([x.ravel(), y.ravel()])


def add_table_on_one_leg() -> bpy.types.Object:
    """Add a selected table whose top hangs over on all sides: supports have to carry its ends."""
    bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 0, 3), scale=(4, 4, 6))
    leg = bpy.context.object
    bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 0, 7), scale=(12, 8, 2))
    leg.select_set(True)
    bpy.ops.object.join()
    return bpy.context.object
