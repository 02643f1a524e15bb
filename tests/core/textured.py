"""Meshes in several colours, and the stages up to the unit bricks run on them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from legorize_addon.core.colours.dominant import SurfaceColours, surface_colours
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import UnitGrid
from legorize_addon.core.slicing.coverage import Pieces, cut_at_grid
from legorize_addon.core.slicing.lattice import Grid, fit_grid
from legorize_addon.core.slicing.levels import Levels, levels_of
from legorize_addon.core.slicing.slices import adaptive_heights, slice_mesh
from legorize_addon.core.slicing.trajectories import Trajectories, link_loops
from legorize_addon.core.unit_bricks.generation import Raster, Rules, unit_bricks
from legorize_addon.core.unit_bricks.surface_samples import (
    SurfaceSamples,
    horizontal_samples,
    standing_pieces,
    trajectory_samples,
)
from tests.core.solids import box, joined, mesh_of, reversed_mesh, sphere

CODES = np.array([0, 1, 2, 4, 14, 15, 25, 28], dtype=np.int16)
"""Brick colours far from each other: black, blue, green, red, yellow, white, orange, dark tan."""


def rgb_of(codes) -> np.ndarray:
    """Return the bytes of brick colours, (n, 3) uint8."""
    catalogue = load_catalogue()
    return catalogue.rgb[[catalogue.colour_row(int(code)) for code in codes]]


def textured(mesh: TriangleMesh, image, uvs=None, *, clamp=False) -> TriangleMesh:
    """Lay one image over a mesh, by its own image coordinates or others."""
    return replace(
        mesh,
        uvs=mesh.uvs if uvs is None else np.asarray(uvs, dtype=np.float64),
        face_image=np.zeros(len(mesh.faces), np.int32),
        images=(np.asarray(image, dtype=np.uint8),),
        image_clamp=np.array([clamp]),
    )


def painted(mesh: TriangleMesh, codes) -> TriangleMesh:
    """Give every face a plain brick colour."""
    kinds, row = np.unique(np.broadcast_to(codes, len(mesh.faces)), return_inverse=True)
    uvs = np.broadcast_to(np.stack([(row + 0.5) / len(kinds), row * 0 + 0.5], axis=1)[:, None], (len(row), 3, 2))
    return textured(mesh, rgb_of(kinds)[None], uvs)


def split_at_x(mesh: TriangleMesh, left=4, right=1) -> TriangleMesh:
    """Paint a mesh whose faces do not cross x = 0 in two colours."""
    return painted(mesh, np.where(mesh.vertices[mesh.faces][..., 0].mean(axis=1) > 0, right, left))


def turned_about_z(profile, n=48) -> TriangleMesh:
    """Make a closed body from a profile (radius, height) that begins and ends on the axis, from below upwards."""
    radius, height = np.asarray(profile, dtype=np.float64).T
    turn = np.arange(n) * 2 * np.pi / n
    rings = radius[:, None, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    z = np.broadcast_to(height[:, None, None], (len(height), n, 1))
    vertices = np.concatenate([rings, z], axis=2).reshape(-1, 3)
    here = np.arange(n)
    lower = n * np.arange(len(height) - 1)[:, None]
    a, b = (lower + here).ravel(), (lower + np.roll(here, -1)).ravel()
    faces = np.concatenate([np.column_stack([a, b, b + n]), np.column_stack([a, b + n, a + n])])
    points = vertices[faces]
    area = np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1)
    kept, row = np.unique(vertices, axis=0, return_inverse=True)
    return mesh_of(kept, row.ravel()[faces[area > 1e-9]])


def cylinder(radius=40.0, height=48.0, n=96) -> TriangleMesh:
    """Make an upright prism of n sides whose faces do not cross x = 0."""
    return turned_about_z([(0, 0), (radius, 0), (radius, height), (0, height)], n)


def torus(radius=48.0, thickness=20.0, n=96, m=32) -> TriangleMesh:
    """Make a ring that lies flat, of n by m squares."""
    along, around = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij")
    reach = radius + thickness * np.cos(around)
    vertices = np.stack([reach * np.cos(along), reach * np.sin(along), thickness * np.sin(around)], axis=-1)
    row = np.arange(n * m).reshape(n, m)
    a, b, c, d = (
        each.ravel() for each in (row, np.roll(row, -1, 0), np.roll(row, (-1, -1), (0, 1)), np.roll(row, -1, 1))
    )
    faces = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    return mesh_of(vertices.reshape(-1, 3), faces)


def hollow_box(outer, inner) -> TriangleMesh:
    """Make a box with a sealed cavity; each is given as (low, high)."""
    return joined(box(*outer), reversed_mesh(box(*inner)))


def table(leg=8.0) -> TriangleMesh:
    """Make a table of 96 x 64 mm, its top 60 to 80 mm high, on four square legs that do not touch each other."""
    places = [(x, y) for x in (0, 96 - leg) for y in (0, 64 - leg)]
    legs = [box((x, y, 0), (x + leg, y + leg, 70)) for x, y in places]
    return joined(*legs, box((0, 0, 60), (96, 64, 80)))


def blob(n=24, radius=200.0, size=128, seed=3) -> TriangleMesh:
    """Make a bumpy ball in patches of many colours, with one image of six squares, one a side of the cube around it."""
    ball = sphere(n)
    way = ball.vertices
    bumps = np.sin(way @ [3.1, 1.3, -0.7]) + np.sin(way @ [-1.1, 2.9, 2.3]) + np.sin(way @ [0.9, -2.2, 4.1])
    corners = way[ball.faces]
    rows = np.arange(len(corners))
    axis = np.abs(corners.mean(axis=1)).argmax(axis=1)
    sign = corners[rows, 0, axis]
    across = (axis[:, None] + [1, 2]) % 3
    flat = (
        np.stack([corners[rows, :, across[:, k]] for k in (0, 1)], axis=-1) / np.abs(corners[rows, :, axis])[..., None]
    )
    side = (2 * axis + (sign > 0))[:, None]
    # half a texel from the rim of its square, so that no neighbour's colour comes in
    uvs = 0.5 + flat * (0.5 - 0.5 / size)
    uvs[..., 0] = (uvs[..., 0] + side) / 6
    return textured(mesh_of(way * (radius * (1 + 0.08 * bumps))[:, None], ball.faces), _patches(size, seed), uvs)


def _patches(size: int, seed: int) -> np.ndarray:
    """Draw the six squares of a ball in patches, (size, 6 size, 3) uint8."""
    rng = np.random.default_rng(seed)
    places = rng.normal(size=(60, 3))
    places /= np.linalg.norm(places, axis=1, keepdims=True)
    colours = rgb_of(CODES[rng.integers(0, len(CODES), len(places))])
    x, y = np.meshgrid(*[(np.arange(size) + 0.5) / size * 2 - 1] * 2)
    squares = []
    for axis in range(3):
        for sign in (-1, 1):
            way = np.roll(np.stack([np.full(x.shape, sign), x, y], axis=-1), axis, axis=-1)
            squares.append(colours[(way / np.linalg.norm(way, axis=-1, keepdims=True) @ places.T).argmax(axis=-1)])
    return np.concatenate(squares, axis=1)


@dataclass(frozen=True, slots=True, eq=False)
class Stages:
    """What the stages before the unit bricks made of a mesh."""

    mesh: TriangleMesh
    surface: SurfaceColours
    grid: Grid
    heights: np.ndarray
    layer: np.ndarray
    plate: np.ndarray
    trajectories: Trajectories

    @property
    def levels(self) -> Levels:
        """What the slices stand for."""
        return levels_of(self.heights, self.layer, self.plate, self.grid)

    def bricks(self, *, keep_thin=True, longest=False) -> UnitGrid:
        """Make the unit bricks."""
        return unit_bricks(
            self.mesh,
            self.trajectories,
            self.surface,
            Raster(self.grid, self.levels),
            Rules(keep_thin=keep_thin, longest=longest),
            catalogue=load_catalogue(),
        )

    def pieces(self) -> tuple[Pieces, np.ndarray]:
        """Cut the trajectories at the grid; return the pieces and the slice of every edge."""
        loops = self.trajectories
        return cut_at_grid(loops.points, loops.ends, self.grid.origin[:2]), loops.loop_slice[loops.edge_loop].astype(
            int
        )

    def steep(self) -> SurfaceSamples:
        """Sample the trajectories."""
        pieces, _ = self.pieces()
        standing = standing_pieces(self.trajectories, pieces, self.levels)
        return trajectory_samples(self.mesh, self.trajectories, pieces, standing, self.levels, self.grid)

    def level(self) -> SurfaceSamples:
        """Sample the level surface."""
        return horizontal_samples(self.mesh, self.surface, self.grid)


def stages(mesh: TriangleMesh, *, grid=None, cusp=3.2, n_colours=64, symmetric=True) -> Stages:
    """Run the stages up to the trajectories on a mesh that has its final size."""
    catalogue = load_catalogue()
    surface = surface_colours(
        mesh,
        catalogue,
        n_colours=n_colours,
        palette=catalogue.codes,
        one_to_one=False,
        rng=np.random.default_rng(0),
    )
    grid = grid or fit_grid(mesh, symmetric=symmetric)
    heights, layer, plate = adaptive_heights(
        mesh, ground=float(grid.origin[2]), n_layers=grid.n_layers, cusp=cusp, colour=surface.of_faces(mesh)
    )
    loops = link_loops(mesh, slice_mesh(mesh, heights), surface)
    return Stages(mesh, surface, grid, heights, layer, plate, loops)


def cells(grid: UnitGrid) -> np.ndarray:
    """Return the colours of whole bricks, (n_layers, n_y, n_x), whose three plates are checked to be equal."""
    assert (grid.colour == grid.colour[:, :1]).all()
    return grid.colour[:, 0]
