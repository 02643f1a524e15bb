"""Keeping the lines and tracebacks of importers and renderers off the user's screen."""

from __future__ import annotations

import ctypes
import faulthandler
import io
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, redirect_stderr, redirect_stdout
from typing import IO, Final

_STREAMS: Final = (1, 2)
"""Standard output and standard error, to which Blender's own code writes past Python."""


@contextmanager
def quiet() -> Iterator[bytearray]:
    """Keep everything that is printed meanwhile off the screen, by Python and by libraries.

    Yields
    ------
    bytearray
        At the end it holds what libraries printed.

    Notes
    -----
    Exceptions pass. Should a library end the process by a signal, the signal and
    the place in Python still go to standard error.
    """
    _flush()
    said = bytearray()
    with ExitStack() as stack:
        kept = [os.dup(stream) for stream in _STREAMS]
        for number in kept:
            stack.callback(os.close, number)
        hidden = stack.enter_context(tempfile.TemporaryFile())
        stack.callback(lambda: said.extend(_content(hidden)))
        for stream, number in zip(_STREAMS, kept, strict=True):
            os.dup2(hidden.fileno(), stream)
            stack.callback(os.dup2, number, stream)
        # what libraries have printed leaves their buffers before the streams are shown again
        stack.callback(_flush)
        if not faulthandler.is_enabled():
            faulthandler.enable(file=kept[1], all_threads=False)
            stack.callback(faulthandler.disable)
        # an importer may keep a handler for its log on these beyond its end
        stack.enter_context(redirect_stdout(io.StringIO()))
        stack.enter_context(redirect_stderr(io.StringIO()))
        yield said


def _content(file: IO[bytes]) -> bytes:
    file.seek(0)
    return file.read()


def _flush() -> None:
    """Empty the buffers of Python and those of C, in which a library's lines may wait until the program ends."""
    sys.stdout.flush()
    sys.stderr.flush()
    ctypes.CDLL("ucrtbase" if os.name == "nt" else None).fflush(None)
