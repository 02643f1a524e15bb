"""Run tests again and again in forks of one process that has loaded the slow libraries, but nothing of the package.

Each line of the input names test files, with tabs between them; the
answer is a line with pytest's exit status. It stops at the first test that fails.
"""

from __future__ import annotations

import importlib
import os
import signal
import sys

import pytest

LIBRARIES = ("hypothesis.extra.numpy", "scipy.optimize", "scipy.sparse.linalg", "scipy.spatial", "sklearn.svm")
KEPT = ("-p", "no:cacheprovider", "-p", "no:randomly")


def serve(limit: int) -> None:
    """Answer until the input ends; tests that take more than ``limit`` seconds are killed, which is a failure."""
    answers = os.fdopen(os.dup(1), "w")
    silent = os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(silent, stream)
    sys.dont_write_bytecode = True  # a module that is changed twice in a second would be taken for the earlier one
    for library in LIBRARIES:
        importlib.import_module(library)
    sys.path.insert(0, os.getcwd())
    for line in sys.stdin:
        child = os.fork()
        if not child:
            signal.alarm(limit)
            os._exit(pytest.main(["-x", "-q", *KEPT, "-m", "not slow and not gui", *line.strip().split("\t")]))
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), file=answers, flush=True)


if __name__ == "__main__":
    serve(int(sys.argv[1]))
