"""The parts and colours to build with, and which part is made in which colour.

The facts are in ``assets/parts.csv``, ``assets/colours.csv`` and
``assets/availability.csv``; ``assets/README.md`` names their sources. The
catalogue holds only colours to build a whole model of: every colour of it may
be used.
"""

from __future__ import annotations

import csv
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final, TypeVar, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arrays import Floats, Ints, Mask
from ..errors import BuildError
from ..units import STUD_LDU
from .parts import MISSING_CELL as MISSING_CELL
from .parts import SLOPED, Part, Profile, Use
from .parts import footprint as footprint
from .unit_grid import COLOUR_ANY

ASSETS: Final = Path(__file__).parents[3] / "assets"

_Row = TypeVar("_Row")


@dataclass(frozen=True, slots=True)
class Colour:
    """A solid, opaque brick colour.

    Attributes
    ----------
    code : int
        LDraw code.
    name : str
        English name as the shops use it.
    rgb : tuple of three int
        LDraw's value, sRGB bytes.
    bricklink, rebrickable, lego : int
        Number of the colour at BrickLink, Rebrickable and LEGO.
    """

    code: int
    name: str
    rgb: tuple[int, int, int]
    bricklink: int
    rebrickable: int
    lego: int


@dataclass(frozen=True, slots=True, eq=False)
class Catalogue:
    """All parts and colours, and which part is made in which colour.

    Attributes
    ----------
    parts : tuple of Part
        In the order of the table: bricks, plates, tall bricks, what only mosaics use, slopes, jumpers, wedge plates.
    colours : tuple of Colour
        By ascending LDraw code.
    exists : (n_parts, n_colours) bool array
        Whether the part was ever made in the colour.
    element : (n_parts, n_colours) int64 array
        LEGO's newest element number of the part in the colour, 0 where it is not known.
    second_element : (n_parts, n_colours) int64 array
        The newest one before that, 0 where there was none.
    cost : (n_parts, n_colours) float64 array, optional
        What a part in a colour costs in a layout, in bricks: by its price, its mass or how many there are. Without it,
        each part costs one brick.
    """

    parts: tuple[Part, ...]
    colours: tuple[Colour, ...]
    exists: Mask
    element: NDArray[np.int64]
    second_element: NDArray[np.int64]
    cost: Floats | None = None

    @property
    def codes(self) -> NDArray[np.int16]:
        """LDraw codes of the colours, ascending, shape (n_colours,)."""
        return np.array([colour.code for colour in self.colours], np.int16)

    @property
    def rgb(self) -> NDArray[np.uint8]:
        """The colours as sRGB bytes, shape (n_colours, 3)."""
        return np.array([colour.rgb for colour in self.colours], np.uint8)

    @property
    def mass(self) -> Floats:
        """Mass of each part in grams, shape (n_parts,)."""
        return np.array([part.mass for part in self.parts])

    @property
    def height(self) -> Ints:
        """Height of each part in plates, shape (n_parts,)."""
        return np.array([part.height for part in self.parts])

    @property
    def studs(self) -> Mask:
        """Whether each part has any studs on top, shape (n_parts,)."""
        return np.array([part.studs for part in self.parts])

    @property
    def sockets(self) -> Mask:
        """Whether each part clutches studs below, shape (n_parts,)."""
        return np.array([part.sockets for part in self.parts])

    def used_for(self, use: Use) -> Mask:
        """Return which parts are laid for something, shape (n_parts,); tiles are for surfaces, too."""
        return np.array(
            [part.use == use or (use == "surface" and part.profile == "tile") for part in self.parts], dtype=bool
        )

    def part_row(self, number: str) -> int:
        """Return the row of the part with an LDraw number or alias.

        Raises
        ------
        BuildError
            There is no such part.
        """
        for row, part in enumerate(self.parts):
            if number == part.number or number in part.aliases:
                return row
        raise BuildError(f"Part {number} is not one of the {len(self.parts)} parts of the catalogue: use one of them.")

    def colour_row(self, code: int) -> int:
        """Return the row of the colour with an LDraw code.

        Raises
        ------
        BuildError
            There is no such colour.
        """
        for row, colour in enumerate(self.colours):
            if code == colour.code:
                return row
        choice = ", ".join(str(colour.code) for colour in self.colours)
        raise BuildError(f"Colour {code} is not in the catalogue: choose one of the LDraw codes {choice}.")

    def colour_rows(self, codes: ArrayLike) -> Ints:
        """Return the rows of the colours with LDraw codes that are in the catalogue, of the shape of `codes`."""
        return np.searchsorted(self.codes, codes)

    def exists_in(self, part_rows: ArrayLike, codes: ArrayLike) -> Mask:
        """Return which parts are made in which colours.

        Parameters
        ----------
        part_rows : integer array
            Rows of parts.
        codes : integer array
            LDraw codes, ``COLOUR_ANY`` for a brick whose colour is still free.
            The two are broadcast against each other.

        Returns
        -------
        bool array
            True where the part is made in the colour or the colour is free;
            False for every colour outside the catalogue.
        """
        codes = np.asarray(codes)
        known = self.codes
        # codes above the last colour point at it too; the comparison tells them apart
        column = np.minimum(np.searchsorted(known, codes), len(known) - 1)
        made = self.exists[np.asarray(part_rows), column] & (known[column] == codes)
        return np.asarray(made | (codes == COLOUR_ANY))


@cache
def load_catalogue() -> Catalogue:
    """Return the catalogue of the add-on, read once.

    Raises
    ------
    BuildError
        A table is missing or damaged.
    """
    return read_catalogue(ASSETS)


def read_catalogue(folder: Path) -> Catalogue:
    """Read ``parts.csv``, ``colours.csv`` and ``availability.csv`` in a folder.

    Parameters
    ----------
    folder : Path
        Where the tables are.

    Returns
    -------
    Catalogue
        Parts in the order of the file, colours by LDraw code.

    Raises
    ------
    BuildError
        A table is missing, a line cannot be understood, or a pair names a part
        or colour that the other tables do not have.
    """
    parts = _read(folder / "parts.csv", _part)
    colours = tuple(sorted(_read(folder / "colours.csv", _colour), key=lambda colour: colour.code))
    part_rows = {part.number: row for row, part in enumerate(parts)}
    colour_rows = {colour.code: row for row, colour in enumerate(colours)}
    pairs = _read(
        folder / "availability.csv",
        lambda cells: (
            part_rows[cells["part"]], colour_rows[int(cells["colour"])],
            int(cells["element"] or 0), int(cells["second_element"] or 0),
        ),
    )  # fmt: skip
    exists = np.zeros((len(parts), len(colours)), bool)
    element, second = np.zeros((2, *exists.shape), np.int64)
    for part, colour, newest, earlier in pairs:
        exists[part, colour] = True
        element[part, colour], second[part, colour] = newest, earlier
    return Catalogue(parts, colours, exists, element, second)


def _read(path: Path, convert: Callable[[dict[str, str]], _Row]) -> tuple[_Row, ...]:
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise BuildError(f"{path} cannot be read ({error.strerror}): install the add-on again.") from error
    lines = csv.DictReader(text.splitlines())
    rows = []
    for cells in lines:
        try:
            rows.append(convert(cells))
        except (KeyError, TypeError, ValueError) as error:
            raise BuildError(
                f"{path}, line {lines.line_num} is wrong ({error!r}): correct it or install the add-on again."
            ) from error
    return tuple(rows)


def _part(cells: dict[str, str]) -> Part:
    length, width = int(cells["length"]), int(cells["width"])
    profile = _word(cells["profile"], Profile)
    if min(length, width) < 1:
        raise ValueError(f"{length} x {width} is no size")
    corners = np.array((cells["outline"] or "").split(), np.float64).reshape(-1, 2) / STUD_LDU
    if length < width and profile not in (*SLOPED, "wedge"):
        raise ValueError(f"{length} x {width} does not name the longer side first")
    return Part(
        number=cells["number"],
        title=cells["title"],
        length=length,
        width=width,
        height=int(cells["height"]),
        profile=profile,
        use=_word(cells["use"], Use),
        mass=float(cells["mass_g"]),
        mass_source=cells["mass_source"],
        aliases=tuple(cells["aliases"].split()),
        outline=tuple((x, y) for x, y in corners.tolist()),
    )


def _word(text: str, choice: Any) -> Any:
    if text not in get_args(choice):
        raise ValueError(f"{text!r} is not one of {', '.join(get_args(choice))}")
    return text


def _colour(cells: dict[str, str]) -> Colour:
    red, green, blue = bytes.fromhex(cells["rgb"].removeprefix("#"))
    return Colour(
        code=int(cells["code"]),
        name=cells["name"],
        rgb=(red, green, blue),
        bricklink=int(cells["bricklink"]),
        rebrickable=int(cells["rebrickable"]),
        lego=int(cells["lego"]),
    )
