"""Blender's own files: whether they are some, and whether what they link to are files."""

from __future__ import annotations

import gzip
import re
import zlib
from collections.abc import Iterable, Iterator
from contextlib import suppress
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import IO, Final

from ...errors import MeshError
from .references import check_regular

_PLAIN: Final = b"BLENDER"
_GZIP: Final = b"\x1f\x8b"
"""Compressed files until Blender 2.93."""

_ZSTANDARD: Final = b"\x28\xb5\x2f\xfd"
"""Compressed files since Blender 3.0."""

_LIBRARY: Final = re.compile(rb"(?<=\0)(?://|/|[A-Za-z]:)[^\0]{1,1000}\.blend(?=\0)")
"""A path of a linked file in a field of text; // is the folder of the file itself."""

_CHUNK: Final = 1 << 24
_OVERLAP: Final = 1024


def check_blend(source: Path) -> tuple[str, ...]:
    """Refuse what is no Blender file, or links to what is no file: Blender would wait for the end of a pipe."""
    with source.open("rb") as file:
        magic = file.read(7)
        if not magic.startswith((_PLAIN, _GZIP, _ZSTANDARD)):
            raise MeshError(
                f"{source.name} is not a Blender file, although its name says so: save it again with Blender."
            )
        file.seek(0)
        check_regular(source, sorted(set(_libraries(_chunks(file, magic)))))
    return ()


def _chunks(file: IO[bytes], magic: bytes) -> Iterator[bytes]:
    """Yield what a file holds before it was compressed; of damaged data what comes before, as Blender tells of it."""
    if magic.startswith(_PLAIN):
        yield from iter(partial(file.read, _CHUNK), b"")
    elif magic.startswith(_GZIP):
        with suppress(OSError, EOFError, zlib.error):
            yield from iter(partial(gzip.GzipFile(fileobj=file).read, _CHUNK), b"")
    # Blender brings it along
    elif find_spec("zstandard") is not None:
        import zstandard

        reader = zstandard.ZstdDecompressor().stream_reader(file, read_across_frames=True)
        with suppress(zstandard.ZstdError):
            yield from iter(partial(reader.read, _CHUNK), b"")


def _libraries(chunks: Iterable[bytes]) -> Iterator[str]:
    """Yield the names of linked files."""
    before = b""
    for chunk in chunks:
        for found in _LIBRARY.findall(before + chunk):
            yield found.decode(errors="replace").removeprefix("//")
        before = chunk[-_OVERLAP:]
