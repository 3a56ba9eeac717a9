"""The process that ``sawflutter study --scheduler`` starts: it computes the saws of a study on a
cluster of Dask.

    python -m sawflutter._scheduler ADDRESS FOLDER

reads scene and study as JSON from its input and fills the log of the folder. Progress goes to the
error stream, and what has gone wrong in one line to the output, with exit code 1.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import Any

from ._progress import Callback, reporting
from .errors import AnalysisError, InputError
from .scene import Scene
from .study import Study

# Seconds between two lines of progress without a terminal.
APART = 10.0


def main(address: str, folder: str) -> int:
    """Runs the study; the exit code is 0 if the log has all saws."""
    import distributed

    # Some functions of distributed have types and others have none.
    connect: Any = distributed.Client
    inputs = json.load(sys.stdin)
    try:
        study = Study(Scene.from_json(json.dumps(inputs["scene"])), inputs["study"])
        try:
            client = connect(address, timeout=15)
        except (OSError, ValueError) as error:
            print(f"there is no scheduler at {address}: {error}")
            return 1
        with client:
            _tell(f"scheduler {address}: {_workers(client)}; dashboard {client.dashboard_link}")
            with reporting(True if sys.stderr.isatty() else _lines(), "saws") as told:
                study._fill(client, Path(folder), told)
    except (AnalysisError, InputError, OSError) as error:
        print(error)
        return 1
    except KeyboardInterrupt:
        # The user who stopped it needs no message.
        return 130
    return 0


def _workers(client: Any) -> str:
    threads = client.nthreads()
    if not threads:
        return "no workers yet, start some with `dask worker` and its address"
    return f"{len(threads)} workers with {sum(threads.values())} threads"


def _lines() -> Callback:
    """Prints lines of progress at intervals."""
    last = [time.monotonic() - APART]

    def told(done: int, of: int, what: str) -> None:
        if done == of or time.monotonic() - last[0] > APART:
            last[0] = time.monotonic()
            _tell(f"{done} of {of} {what}")

    return told


def _tell(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
