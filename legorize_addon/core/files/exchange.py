"""Exchange two folders in one step, where the system can do that.

Python has no function for it, so the system's own is called.

References
----------
Linux, renameat2(2), flag ``RENAME_EXCHANGE``; macOS, renamex_np(2), flag ``RENAME_SWAP``.
"""

from __future__ import annotations

import ctypes
import os
import sys
from pathlib import Path
from typing import Final

_HERE: Final = -100
"""``AT_FDCWD`` of Linux: relative paths begin at the working folder."""

_SWAP: Final = 2
"""``RENAME_EXCHANGE`` and ``RENAME_SWAP`` alike."""


def exchange(one: Path, other: Path) -> bool:
    """Let two folders of one file system change places.

    Returns
    -------
    bool
        Whether they did. If the system or the file system has no such call or refuses it, nothing has changed.
    """
    if sys.platform == "win32":
        return False
    system = ctypes.CDLL(None, use_errno=True)
    first, second = (ctypes.c_char_p(os.fsencode(path)) for path in (one, other))
    if hasattr(system, "renameat2"):
        return int(system.renameat2(_HERE, first, _HERE, second, ctypes.c_uint(_SWAP))) == 0
    if hasattr(system, "renamex_np"):
        return int(system.renamex_np(first, second, ctypes.c_uint(_SWAP))) == 0
    return False
