"""Threads, progress, Ctrl-C and faults."""

from __future__ import annotations

import logging
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

import sawflutter as sf
from sawflutter import _native


def test_python_runs_while_a_chart_is_computed(draft: sf.Scene) -> None:
    beats = 0
    done = threading.Event()

    def beat() -> None:
        nonlocal beats
        while not done.is_set():
            beats += 1
            time.sleep(0.005)

    counting = threading.Thread(target=beat)
    counting.start()
    # One call of the compiled part: if it held the lock, there would be no beat during it.
    before = beats
    options = {"sensitivity": False, "amplitude": False, "shapes_at_rpm": None}
    _native.run("analyze", sf.Scene.paper().with_accuracy("reference").to_json(), options)
    after = beats
    done.set()
    counting.join()
    assert after - before >= 5


def test_several_threads_compute_at_once(draft: sf.Scene) -> None:
    saws = [draft.replace({"blade.thickness_m": 2.6e-3 + 1e-5 * k}) for k in range(6)]
    alone = [saw.run_campbell() for saw in saws]
    with ThreadPoolExecutor(3) as threads:
        together = list(threads.map(lambda saw: saw.run_campbell(), saws))
    assert together == alone


def test_progress_is_told_to_a_callable(draft: sf.Scene) -> None:
    told: list[tuple[int, int]] = []
    sf.Scene.paper().run_campbell(
        accuracy="reference", progress=lambda done, of, _: told.append((done, of))
    )
    assert told, "a chart takes longer than a beat"
    assert told[-1][0] == told[-1][1] > 0
    assert all(0 <= done <= of for done, of in told)
    assert len({of for _, of in told}) > 1, "the search for bands is told, not the chart alone"


def test_progress_is_shown_as_a_bar(draft: sf.Scene, capsys: pytest.CaptureFixture[str]) -> None:
    draft.run_campbell(progress=True)
    shown = capsys.readouterr()
    assert "pieces of the search" in shown.err and shown.out == ""
    # A bar without a total would begin with "0it".
    assert ": 0it" not in shown.err and "100%" in shown.err.splitlines()[-1]


def test_the_phase_is_named_to_every_callable(draft: sf.Scene) -> None:
    told: list[tuple[int, int, str]] = []

    def tell(done: int, of: int, phase: str) -> None:
        told.append((done, of, phase))

    draft.run_campbell(progress=tell)
    draft.run_stiffness_map([1e7], progress=tell)
    sf.compare([draft, draft], progress=tell)
    phases = {phase for *_, phase in told}
    assert {"pieces of the search", "saws"} <= phases and "" not in phases


def test_an_exception_of_the_callable_ends_the_computation(draft: sf.Scene) -> None:
    class Enough(Exception):
        pass

    def enough(done: int, of: int, phase: str) -> None:
        raise Enough

    began = time.monotonic()
    with pytest.raises(Enough):
        sf.Scene.paper().replace({"sweep.to_rpm": 6000}).run_campbell(
            accuracy="reference", progress=enough
        )
    assert time.monotonic() - began < 5.0


def test_a_long_sweep_is_estimated_before_its_search(draft: sf.Scene) -> None:
    class Enough(Exception):
        pass

    class Handler(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            raise Enough(record.getMessage())

    handler, logger = Handler(), logging.getLogger("sawflutter")
    logger.addHandler(handler)
    try:
        # On the basis of a draft the sweep has 40 critical speeds, and 22 already take some seconds.
        with pytest.raises(Enough, match="40 critical speeds.*minutes.*estimate.*sweep.to_rpm"):
            draft.run_campbell(speed_range=(0, 10_000))
        draft.run_campbell()
    finally:
        logger.removeHandler(handler)


def test_a_panic_is_an_exception(capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(RuntimeError, match="a fault of sawflutter.*asked for by a test"):
        _native.panic()
    # The next computation is unaffected.
    assert sf.Scene.paper().check(operating_rpm=1250, accuracy="draft").passed


INTERRUPTED = """
import signal, sys, threading, time
import sawflutter as sf
saw = sf.Scene.paper().replace({{"sweep.to_rpm": 6000}})
assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
print("ready", flush=True)
try:
    {work}
except KeyboardInterrupt:
    arrived = time.time()
    # The threads of the computation end by themselves: it takes no more of the processor.
    time.sleep(1.0)
    used = time.process_time()
    time.sleep(0.5)
    print(repr(arrived), time.process_time() - used, flush=True)
    sys.exit(3)
print("not interrupted", flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="SIGINT is sent otherwise there")
@pytest.mark.parametrize(
    "work",
    [
        "saw.run_campbell(accuracy='reference')",
        "saw.place(samples=64)",
        "saw.run_up(accuracy='reference')",
        "saw.fit(to_rpm=1250, starts=500)",
        "saw.run_cut(accuracy='reference')",
        "saw.tradeoff()",
    ],
)
def test_ctrl_c_arrives_within_a_fifth_of_a_second_and_stops_the_computation(work: str) -> None:
    script = INTERRUPTED.format(work=work)
    with subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, text=True
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == "ready\n"
        time.sleep(0.3)
        sent = time.time()
        child.send_signal(signal.SIGINT)
        told = child.stdout.read()
        assert child.wait(60) == 3, told
    arrived, used = map(float, told.split())
    assert arrived - sent < 0.2, f"{arrived - sent:.3f} s"
    assert used < 0.1, f"{used:.3f} s of the processor after it"
