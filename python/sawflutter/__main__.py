"""The program `sawflutter`, as pip installs it and ``python -m sawflutter`` runs it."""

from __future__ import annotations

import os
import signal
import sys

from . import _native


def main() -> int:
    """Runs the program with the arguments of the command line; its exit code."""
    # As of any other program: Ctrl-C and a closed pipe end it, and Python does not come between.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    # For `study --scheduler`, which starts Python.
    os.environ.setdefault("SAWFLUTTER_PYTHON", sys.executable)
    return _native.program(["sawflutter", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
