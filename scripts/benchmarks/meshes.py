"""Model files read without Blender, and meshes made finer."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
import trimesh
from numpy.typing import NDArray

from legorize_addon.core.colours.counted import count_texels
from legorize_addon.core.colours.dominant import SurfaceColours, chosen_palette, surface_colours
from legorize_addon.core.errors import MeshError
from legorize_addon.core.mesh.size import model_scale, scale_mesh
from legorize_addon.core.mesh.triangle_mesh import Repairs, TriangleMesh, repair
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.settings import Settings
from legorize_addon.core.units import MM_PER_METRE

Floats = NDArray[np.float64]
Bytes = NDArray[np.uint8]

SUFFIXES: Final = (".glb", ".gltf", ".obj", ".ply", ".stl")

_GLTF: Final = (".glb", ".gltf")
_Y_UP: Final = (*_GLTF, ".obj")
_GREY: Final = 160
"""Of a mesh that has no colours at all."""

# corners 0 to 2 of a triangle and the middles 3 to 5 of the sides after them, as four triangles
_QUARTERS: Final = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]])


@dataclass(frozen=True, slots=True, eq=False)
class Model:
    """A repaired mesh in the size of its brick model.

    Attributes
    ----------
    name : str
        Of the file.
    mesh : TriangleMesh
    surface : SurfaceColours
    repairs : Repairs
    """

    name: str
    mesh: TriangleMesh
    surface: SurfaceColours
    repairs: Repairs


def models_in(folder: Path) -> list[Path]:
    """Return the model files of a folder and its folders, by name."""
    return sorted((path for path in folder.rglob("*") if path.suffix.lower() in SUFFIXES), key=lambda path: path.name)


def prepared(path: Path, settings: Settings) -> Model:
    """Read, repair and scale a mesh and find its colours, as the pipeline does."""
    return prepared_mesh(path.stem, read_mesh(path), settings)


def prepared_mesh(name: str, mesh: TriangleMesh, settings: Settings) -> Model:
    """Repair and scale a mesh and find its colours, as the pipeline does."""
    mesh, repairs = repair(mesh)
    size = {name: getattr(settings, name) for name in ("size_by", "width", "height", "scale", "cm")}
    mesh = scale_mesh(mesh, model_scale(mesh, **size))
    return Model(name, mesh, textured(mesh, settings), repairs)


def textured(mesh: TriangleMesh, settings: Settings) -> SurfaceColours:
    """Return the brick colours of a mesh's images, as the pipeline finds them."""
    catalogue = load_catalogue()
    return surface_colours(
        mesh,
        catalogue,
        n_colours=settings.colours,
        palette=chosen_palette(settings.palette, catalogue),
        one_to_one=settings.one_to_one,
        rng=np.random.default_rng(settings.seed),
        texels=count_texels(mesh.images) if settings.sampling == "image" else None,
    )


def read_mesh(path: Path) -> TriangleMesh:
    """Read a model file: metres become mm, and z is up.

    Parameters
    ----------
    path : Path
        Its plain colours and images are read.

    Returns
    -------
    TriangleMesh

    Raises
    ------
    MeshError
        The file is of no known kind, has no faces, or is coloured by vertices.
    """
    if path.suffix.lower() not in SUFFIXES:
        raise MeshError(f"{path.name} is of no known kind: use one of {', '.join(SUFFIXES)}.")
    bodies = [body for body in trimesh.load_scene(path).dump() if isinstance(body, trimesh.Trimesh) and len(body.faces)]
    if not bodies:
        raise MeshError(f"{path.name} has no faces: choose a file with a surface.")
    n_faces = [len(body.faces) for body in bodies]
    first = np.cumsum([0, *(len(body.vertices) for body in bodies[:-1])])
    points = np.concatenate([body.vertices for body in bodies]) * MM_PER_METRE
    images = [_image(body, linear_factor=path.suffix.lower() in _GLTF) for body in bodies]
    # bodies share images, and as in Blender each enters once
    album = {(image.shape, image.tobytes()): image for image in images}
    rows = {key: row for row, key in enumerate(album)}
    of_body = np.array([rows[image.shape, image.tobytes()] for image in images], dtype=np.int32)
    return TriangleMesh(
        vertices=points[:, [0, 2, 1]] * [1.0, -1.0, 1.0] if path.suffix.lower() in _Y_UP else points,
        faces=np.concatenate([body.faces + start for body, start in zip(bodies, first, strict=True)]).astype(np.int32),
        uvs=np.concatenate([_uvs(body) for body in bodies]),
        face_image=np.repeat(of_body, n_faces),
        images=tuple(album.values()),
        image_clamp=np.zeros(len(album), dtype=bool),
    )


def as_trimesh(mesh: TriangleMesh) -> trimesh.Trimesh:
    """Return the mesh for the reference, as it is."""
    return trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)


def subdivided(mesh: TriangleMesh, triangles: int) -> TriangleMesh:
    """Quarter all triangles until there are about so many: at most twice as many, more than half as many.

    Parameters
    ----------
    mesh : TriangleMesh
    triangles : int
        0 leaves the mesh as it is.

    Returns
    -------
    TriangleMesh
        The same surface with the same colours.
    """
    while 2 * len(mesh.faces) < triangles:
        mesh = _quartered(mesh)
    return mesh


def _quartered(mesh: TriangleMesh) -> TriangleMesh:
    sides = np.stack([mesh.faces, mesh.faces[:, [1, 2, 0]]], axis=2).reshape(-1, 2)
    edges, number = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True)
    corners = np.hstack([mesh.faces, len(mesh.vertices) + number.reshape(-1, 3)])
    uvs = np.concatenate([mesh.uvs, (mesh.uvs + mesh.uvs[:, [1, 2, 0]]) / 2], axis=1)
    return replace(
        mesh,
        vertices=np.concatenate([mesh.vertices, mesh.vertices[edges].mean(axis=1)]),
        faces=corners[:, _QUARTERS].reshape(-1, 3).astype(np.int32),
        uvs=uvs[:, _QUARTERS].reshape(-1, 3, 2),
        face_image=np.repeat(mesh.face_image, len(_QUARTERS)),
    )


def _uvs(body: trimesh.Trimesh) -> Floats:
    uv = getattr(body.visual, "uv", None)
    if uv is None:
        return np.zeros((len(body.faces), 3, 2))
    corners: Floats = np.asarray(uv, dtype=np.float64)[body.faces]
    return corners


def _image(body: trimesh.Trimesh, *, linear_factor: bool) -> Bytes:
    """Return the image of a body, times the colour factor of its material, rows from the bottom."""
    visual: Any = body.visual
    if visual.kind in ("vertex", "face"):
        raise MeshError("A mesh coloured by its vertices or faces cannot be measured: give it a material or an image.")
    if visual.kind is None:
        return np.full((1, 1, 3), _GREY, dtype=np.uint8)
    material = visual.material
    factor = _factor(material)
    if not linear_factor:
        factor = _linear(factor)
    image = getattr(material, "baseColorTexture", getattr(material, "image", None))
    if image is None or visual.uv is None:
        return _bytes(factor).reshape(1, 1, 3)
    # light is multiplied, not bytes
    table = _bytes(_linear(np.arange(256) / 255)[:, None] * factor)
    pixels = np.asarray(image.convert("RGB"))[::-1]
    return np.stack([table[pixels[..., channel], channel] for channel in range(3)], axis=-1)


def _factor(material: Any) -> Floats:
    """Return the colour factor of a material, 0 to 1."""
    factor = getattr(material, "baseColorFactor", getattr(material, "diffuse", None))
    if factor is None:
        return np.ones(3)
    values = np.asarray(factor)[:3]
    return values / 255 if values.dtype.kind in "ui" else values.astype(np.float64)


def _linear(srgb: Floats) -> Floats:
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def _bytes(linear: Floats) -> Bytes:
    """Return linear light as sRGB bytes."""
    srgb = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return np.round(np.clip(srgb, 0, 1) * 255).astype(np.uint8)
