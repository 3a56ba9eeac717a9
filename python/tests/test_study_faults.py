"""Studies on real processes that are killed, on disks that are full and with workers of other
versions: every saw is in the log once, and the files are those of one run on one thread."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from pathlib import Path
from threading import Thread
from typing import Any

import pytest

import sawflutter as sf

distributed = pytest.importorskip("distributed")
psutil = pytest.importorskip("psutil")

SAWS = 2400
# A saw takes some milliseconds, so that there is time to kill workers during a run.
STUDY: dict[str, Any] = {
    "name": "Thickness",
    "saws": SAWS,
    "to_rpm": 1000,
    "parameters": [
        {
            "path": "blade.thickness_m",
            "distribution": {"kind": "normal", "standard_deviation": 5e-5},
        }
    ],
    "limits": {"operating_rpm": 1250},
}
FILES = ("study.csv", "study.json", "study.parquet", "study.png", "study.svg")


@pytest.fixture(scope="module")
def study(draft: sf.Scene) -> sf.Study:
    return sf.Study(draft.replace({"guides": []}), STUDY)


@pytest.fixture(scope="module")
def alone(
    study: sf.Study, programs: list[str], tmp_path_factory: pytest.TempPathFactory
) -> dict[str, bytes]:
    """The files of a run of the program on one thread."""
    folder = tmp_path_factory.mktemp("alone")
    done = subprocess.run(
        [programs[0], "study", *inputs(study, folder), "--out", str(folder / "out")],
        env={**os.environ, "RAYON_NUM_THREADS": "1"},
        check=False,
        capture_output=True,
    )
    assert done.returncode == 0, done.stderr
    return files(folder / "out")


def inputs(study: sf.Study, folder: Path) -> list[str]:
    """The files of the scene and the study, for the program."""
    paths = [folder / "scene.json", folder / "tolerances.json"]
    study.scene.save(paths[0])
    paths[1].write_text(json.dumps(STUDY))
    return [str(path) for path in paths]


def files(folder: Path) -> dict[str, bytes]:
    return {name: (folder / name).read_bytes() for name in FILES}


def logged(folder: Path) -> list[int]:
    """Numbers of the saws in the log, without an incomplete last line."""
    try:
        text = (folder / "study.log").read_text()
    except FileNotFoundError:
        return []
    lines = text[: text.rfind("\n") + 1].splitlines()[2:]
    return [int(line.split(",")[0]) for line in lines if not line.startswith("#")]


class Cluster:
    """A scheduler and its workers, every one a process of its own."""

    def __init__(self, folder: Path) -> None:
        self.file = folder / "scheduler.json"
        self.processes: list[subprocess.Popen[bytes]] = []
        arguments = ["--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--no-show"]
        self.scheduler = self.start("scheduler", *arguments)
        wait_for(self.file.exists)

    def start(self, *arguments: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", "dask", *arguments, "--scheduler-file", str(self.file)]
        process = subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
        )
        self.processes.append(process)
        return process

    def start_worker(self, *more: str) -> subprocess.Popen[bytes]:
        """A worker of one thread, which its nanny starts again when it is killed."""
        return self.start("worker", "--nthreads", "1", "--no-dashboard", *more)

    def workers(self) -> list[Any]:
        """The processes that compute."""
        found = []
        for process in self.processes[1:]:
            for child in psutil.Process(process.pid).children(recursive=True):
                try:
                    if "spawn_main" in " ".join(child.cmdline()):
                        found.append(child)
                except psutil.Error:
                    # The process has just ended.
                    continue
        return found

    def stop(self) -> None:
        for process in reversed(self.processes):
            for child in psutil.Process(process.pid).children(recursive=True):
                child.kill()
            process.kill()
            process.wait()


def wait_for(condition: Callable[[], Any], seconds: float = 60.0) -> None:
    begun = time.monotonic()
    while not condition():
        assert time.monotonic() - begun < seconds, "in vain"
        time.sleep(0.02)


@contextmanager
def cluster(folder: Path, workers: int, *more: str) -> Iterator[tuple[Cluster, Any]]:
    one = Cluster(folder)
    try:
        for _ in range(workers):
            one.start_worker(*more)
        with distributed.Client(scheduler_file=str(one.file)) as client:
            if workers > 0:
                client.wait_for_workers(workers, timeout=60)
            yield one, client
    finally:
        one.stop()


# The study sleeps at its saws, so that there is time to kill it during a run.
SLOW = """
import time
from sawflutter import _tasks
read = _tasks.__dict__.setdefault("_read", _tasks._study)
class Slow:
    def __init__(self, study): self.study = study
    def rows(self, first, last):
        time.sleep(0.004 * (last - first))
        return self.study.rows(first, last)
_tasks._study = lambda text: Slow(read(_tasks.Text(*text)))
"""


def test_workers_that_are_killed_lose_no_saw(
    study: sf.Study, alone: dict[str, bytes], tmp_path: Path
) -> None:
    (tmp_path / "slow.py").write_text(SLOW)
    killed: list[tuple[int, int]] = []
    with cluster(tmp_path, 2, "--preload", str(tmp_path / "slow.py")) as (one, client):

        def kill() -> None:
            wait_for(lambda: logged(tmp_path / "out"))
            for _ in range(6):
                fresh: list[Any] = []
                while not fresh:
                    time.sleep(0.5)
                    fresh = [worker for worker in one.workers() if worker.pid not in dict(killed)]
                fresh[-1].kill()
                killed.append((fresh[-1].pid, len(logged(tmp_path / "out"))))

        killer = Thread(target=kill)
        killer.start()
        study.run(tmp_path / "out", executor=client)
        killer.join()
    # All six processes are computing.
    assert len(dict(killed)) == 6 and all(done < SAWS for _, done in killed), killed
    assert sorted(logged(tmp_path / "out")) == list(range(SAWS))
    assert files(tmp_path / "out") == alone


def test_a_lost_scheduler_ends_the_run_and_the_next_one_goes_on(
    study: sf.Study, alone: dict[str, bytes], tmp_path: Path
) -> None:
    with cluster(tmp_path, 2) as (one, client):

        def kill() -> None:
            wait_for(lambda: len(logged(tmp_path / "out")) > SAWS // 8)
            one.scheduler.kill()

        killer = Thread(target=kill)
        killer.start()
        with pytest.raises(sf.AnalysisError, match="run the study again"):
            study.run(tmp_path / "out", executor=client)
        killer.join()
    before = logged(tmp_path / "out")
    assert SAWS // 8 < len(before) < SAWS and not (tmp_path / "out" / "study.json").exists()
    (tmp_path / "scheduler.json").unlink()
    with cluster(tmp_path, 1) as (_, client):
        study.run(tmp_path / "out", executor=client)
    after = logged(tmp_path / "out")
    assert after[: len(before)] == before and sorted(after) == list(range(SAWS))
    assert files(tmp_path / "out") == alone


# A worker that gets saw 37 ends at once. A preload can be run twice.
POISON = """
import os, signal
from sawflutter import _tasks
read = _tasks.__dict__.setdefault("_read", _tasks._study)
class Poisoned:
    def __init__(self, study): self.study = study
    def rows(self, first, last):
        if first <= 37 < last:
            os.kill(os.getpid(), signal.SIGKILL)
        return self.study.rows(first, last)
_tasks._study = lambda text: Poisoned(read(_tasks.Text(*text)))
"""


def test_a_saw_that_ends_its_workers_is_a_row_with_the_reason(
    study: sf.Study, alone: dict[str, bytes], tmp_path: Path
) -> None:
    preload = tmp_path / "poison.py"
    preload.write_text(POISON)
    few = sf.Study(study.scene, {**STUDY, "saws": 60})
    with cluster(tmp_path, 2, "--preload", str(preload)) as (_, client):
        result = few.run(tmp_path / "out", executor=client)
    assert sorted(logged(tmp_path / "out")) == list(range(60))
    assert (result.all.saws, result.all.failed, result.all.refused) == (60, 1, 0)
    (failed,) = result.not_analysed
    assert failed.saw == 37 and "ended every worker" in failed.reason
    # All others are as in a study without it: a study's first saws are those of a longer one.
    ours = (tmp_path / "out" / "study.csv").read_text().splitlines()
    theirs = alone["study.csv"].decode().splitlines()[:61]
    assert [k for k in range(61) if ours[k] != theirs[k]] == [38]


@pytest.mark.parametrize(
    ("preload", "said"),
    [
        ("import sawflutter\nsawflutter.__version__ = '0.0.9'\n", "a worker has sawflutter 0.0.9"),
        ("import sys\nsys.modules['sawflutter'] = None\n", "cannot import sawflutter"),
    ],
)
def test_workers_without_this_version_are_refused_before_the_first_task(
    study: sf.Study, tmp_path: Path, preload: str, said: str
) -> None:
    (tmp_path / "preload.py").write_text(preload)
    with (
        cluster(tmp_path, 1, "--preload", str(tmp_path / "preload.py")) as (_, client),
        pytest.raises(sf.AnalysisError, match=said),
    ):
        study.run(tmp_path / "out", executor=client)
    assert logged(tmp_path / "out") == []


def test_the_program_computes_on_a_scheduler(
    study: sf.Study, alone: dict[str, bytes], programs: list[str], tmp_path: Path
) -> None:
    given = inputs(study, tmp_path)
    with cluster(tmp_path, 1) as (one, _):
        address = json.loads(one.file.read_text())["address"]
        for number, program in enumerate(programs):
            folder = tmp_path / str(number)
            done = subprocess.run(
                [program, "study", *given, "--out", str(folder), "--scheduler", address],
                env={**os.environ, "SAWFLUTTER_PYTHON": sys.executable},
                check=False,
                capture_output=True,
                text=True,
            )
            assert done.returncode == 0, done.stderr
            assert files(folder) == alone
            assert "1 workers with 1 threads; dashboard http" in done.stderr
            assert f"{SAWS} of {SAWS} saws" in done.stderr


# Two types of processors, one on each worker.
PROCESSOR = """
import os
from sawflutter import _native
_native.processor = lambda: os.environ["KIND"]
"""


def test_differing_processors_are_in_the_report(study: sf.Study, tmp_path: Path) -> None:
    (tmp_path / "preload.py").write_text(PROCESSOR)
    few = sf.Study(study.scene, {**STUDY, "saws": 100})
    with cluster(tmp_path, 0) as (one, client):
        for kind in ("one", "other"):
            os.environ["KIND"] = f"x86_64, {kind}"
            one.start_worker("--preload", str(tmp_path / "preload.py"))
        client.wait_for_workers(2, timeout=60)
        result = few.run(tmp_path / "out", executor=client)
    del os.environ["KIND"]
    assert result.processors == ("x86_64, one", "x86_64, other")
    assert not few.run(tmp_path / "alone").processors


def test_a_closed_client_says_how_to_go_on(study: sf.Study, tmp_path: Path) -> None:
    with cluster(tmp_path, 1) as (_, client):

        def close(done: int, of: int, phase: str) -> None:
            client.close()

        with pytest.raises(sf.AnalysisError, match="run the study again"):
            study.run(tmp_path / "out", executor=client, progress=close)
    assert 0 < len(logged(tmp_path / "out")) < SAWS


def test_a_broken_pool_says_how_to_go_on(
    study: sf.Study, alone: dict[str, bytes], tmp_path: Path
) -> None:
    def kill(done: int, of: int, phase: str) -> None:
        if done > SAWS // 8:
            for process in list((pool._processes or {}).values()):
                process.kill()

    with (
        ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool,
        pytest.raises(sf.AnalysisError, match="run the study again with a new executor"),
    ):
        study.run(tmp_path, executor=pool, progress=kill)
    assert 0 < len(logged(tmp_path)) < SAWS
    study.run(tmp_path)
    assert sorted(logged(tmp_path)) == list(range(SAWS)) and files(tmp_path) == alone


CLIENT = """
import sys
from concurrent.futures import ThreadPoolExecutor
import sawflutter as sf
if len(sys.argv) > 4:
    import resource
    # Python ignores the signal, so that writing fails as on a full disk.
    resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[4]), int(sys.argv[4])))
study = sf.Study(sf.Scene.load(sys.argv[1]), sys.argv[2])
with ThreadPoolExecutor(2) as threads:
    study.run(sys.argv[3], executor=threads)
"""


def client(study: sf.Study, folder: Path, *more: str) -> subprocess.Popen[str]:
    """A client that computes on threads of its own, as a process."""
    given = [*inputs(study, folder), str(folder / "out")]
    command = [sys.executable, "-c", CLIENT, *given, *more]
    return subprocess.Popen(command, stderr=subprocess.PIPE, text=True)


def test_a_client_that_is_killed_loses_no_saw(
    study: sf.Study, alone: dict[str, bytes], tmp_path: Path
) -> None:
    for share in (8, 4, 2):
        killed = client(study, tmp_path)
        wait_for(lambda share=share: len(logged(tmp_path / "out")) > SAWS // share)  # type: ignore[misc]
        killed.kill()
        killed.communicate()
    # The log also ends in the middle of a line.
    log = tmp_path / "out" / "study.log"
    log.write_bytes(log.read_bytes()[:-7])
    before = logged(tmp_path / "out")
    study.run(tmp_path / "out")
    after = logged(tmp_path / "out")
    assert after[: len(before)] == before and sorted(after) == list(range(SAWS))
    assert files(tmp_path / "out") == alone


# The disk is full in the log, in the tables of the saws, and in the last of the other files.
@pytest.mark.skipif(sys.platform == "win32", reason="there are no limits of files")
@pytest.mark.parametrize("room", [40_000, 150_000])
def test_a_full_disk_ends_the_run_and_the_next_one_goes_on(
    study: sf.Study, alone: dict[str, bytes], tmp_path: Path, room: int
) -> None:
    full = client(study, tmp_path, str(room))
    _, said = full.communicate()
    assert full.returncode == 1 and "OSError" in said and "File too large" in said, said
    left = {path.name for path in (tmp_path / "out").iterdir()}
    assert left == {"study.log"}
    before = logged(tmp_path / "out")
    assert 0 < len(before) <= SAWS
    study.run(tmp_path / "out")
    after = logged(tmp_path / "out")
    assert after[: len(before)] == before and sorted(after) == list(range(SAWS))
    assert files(tmp_path / "out") == alone
