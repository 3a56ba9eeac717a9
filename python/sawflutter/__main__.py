"""The program `sawflutter`, as installed by pip and run by ``python -m sawflutter``."""

from __future__ import annotations

import os
import signal
import sys

from . import _native


def main() -> int:
    """Runs the program with the arguments of the command line and gives its exit code."""
    # Ctrl-C and a closed pipe end the program directly, without a traceback of Python.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    # `study --scheduler` starts Python again.
    os.environ.setdefault("SAWFLUTTER_PYTHON", sys.executable)
    return _native.program(["sawflutter", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
