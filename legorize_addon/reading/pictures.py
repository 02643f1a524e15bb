"""Images for mosaics: from files, and from those of the open scene."""

from __future__ import annotations

from pathlib import Path

import bpy

from ..core.errors import MeshError
from ..core.files.sources import PICTURES, PictureHead, check_file, check_picture, unchanged
from ..core.mosaic import Picture, picture_of
from .images import LARGEST_SIDE, is_missing, is_readable, read_pixels, step_of
from .quiet import quiet


def load_picture(source: Path) -> tuple[Picture, tuple[str, ...]]:
    """Read an image file as it is seen, turned as its camera was held.

    Parameters
    ----------
    source : pathlib.Path
        A .png or .jpg file.

    Returns
    -------
    Picture
    tuple of str
        What could not be taken literally.

    Raises
    ------
    MeshError
        The file cannot be read, or its colours are inks.
    """
    check_file(source)
    with unchanged(source):
        head = check_picture(source)
        try:
            with quiet():
                image = bpy.data.images.load(str(source.resolve()))
        except RuntimeError as error:
            raise MeshError(f"{source.name} cannot be read ({error}): save it again.") from error
        try:
            if is_missing(image):
                raise MeshError(f"{source.name} is incomplete or damaged: export or download it again.")
            remarks = remarks_on(image)
            colours, alpha = read_pixels(image)
        finally:
            bpy.data.images.remove(image)
    return picture_of(head.upright(colours), head.upright(alpha)), remarks


def picture_from(image: bpy.types.Image) -> tuple[Picture, tuple[str, ...]]:
    """Read an image of the open file; see :func:`load_picture`."""
    if is_missing(image):
        raise MeshError(f"The image {image.name!r} has no pixels: choose another one, or find its file.")
    if not is_readable(image):
        raise MeshError(
            f"The image {image.name!r} has the colour space {image.colorspace_settings.name!r}, which only Cycles can "
            "read: save it as sRGB."
        )
    colours, alpha = read_pixels(image)
    head = _head_of(image)
    if head is not None:
        colours, alpha = head.upright(colours), head.upright(alpha)
    return picture_of(colours, alpha), remarks_on(image)


def _head_of(image: bpy.types.Image) -> PictureHead | None:
    """Return what the file of an image says of it; None if its pixels are not those of a file that can be asked."""
    path = Path(bpy.path.abspath(image.filepath, library=image.library))
    asked = image.source == "FILE" and not image.is_dirty and not image.packed_file
    return check_picture(path) if asked and path.suffix.lower() in PICTURES and path.is_file() else None


def remarks_on(image: bpy.types.Image) -> tuple[str, ...]:
    """Return a sentence if an image is used at less than its size."""
    step = step_of(image)
    if step == 1:
        return ()
    return (f"The image {image.name!r} is larger than {LARGEST_SIDE} pixels: it was used at 1/{step} of its size.",)
