"""Progress, Ctrl-C and threads."""
import contextlib
import json
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import emmy

FOREVER = 10**12  # Steps.


def test_progress_ends_with_the_last_step(box):
    calls = []
    emmy.Simulation(box).run(50, progress=lambda *call: calls.append(call))
    assert calls[-1] == (50, 50)
    assert calls == sorted(calls)


def test_progress_comes_at_most_ten_times_a_second(box):
    times = []

    def progress(done, total):
        times.append(time.monotonic())
        return len(times) < 4

    emmy.Simulation(box).run(FOREVER, every=FOREVER, progress=progress)
    # 0.1 s apart, less the scheduling of two clocks.
    assert min(np.diff(times)) > 0.05


@pytest.mark.parametrize("false", [False, np.False_, 0, ""])
def test_progress_ends_a_run_by_returning_what_is_false(box, false):
    simulation = emmy.Simulation(box)
    answers = iter([false])  # Raises if it is asked again.
    history = simulation.run(
        FOREVER, every=FOREVER, progress=lambda done, total: next(answers))
    assert simulation.step > 0
    assert history["step"].tolist() == [0, simulation.step]


@pytest.mark.parametrize("other", [None, True, np.True_, 1, "on"])
def test_progress_goes_on_with_none_and_what_is_true(box, other):
    answers = iter([other, False])
    simulation = emmy.Simulation(box)
    simulation.run(
        FOREVER, every=FOREVER, progress=lambda done, total: next(answers))
    assert not list(answers)


def test_an_answer_of_progress_without_a_truth_value_raises(box):
    answers = iter([np.zeros(2)])
    with pytest.raises(ValueError, match="ambiguous"):
        emmy.Simulation(box).run(
            FOREVER, every=FOREVER, progress=lambda done, total: next(answers))


def test_an_exception_of_progress_arrives(box):
    simulation = emmy.Simulation(box)

    def progress(done, total):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        simulation.run(FOREVER, every=FOREVER, progress=progress)
    stopped = simulation.step
    assert simulation.history["step"].tolist() == [0, stopped]
    simulation.advance()  # It can go on.
    assert simulation.step == stopped + 1


def test_ctrl_c_ends_a_run(box):
    simulation = emmy.Simulation(box)
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        simulation.run(FOREVER, every=1000)
    steps = simulation.history["step"]
    assert steps[-1] == simulation.step > 0
    assert np.isfinite(simulation.history.data).all()


# Ctrl-C while a thread works: the interpreter shuts down around that thread, and
# takes long enough for it to ask for Python's lock, which it gets no more.
INTERRUPTED = """
import signal, sys, threading, time
import emmy

class LongGone:
    sleep = staticmethod(time.sleep)
    def __del__(self):
        self.sleep(0.5)

def progress(done, total):
    time.sleep(float(sys.argv[4]))

class Case(dict):
    def __iter__(self, sleep=time.sleep):
        while True:
            sleep(0.1)

class Path:
    def __fspath__(self, sleep=time.sleep):
        while True:
            sleep(0.1)

def run(steps=10**12, progress=None):
    simulation = emmy.Simulation.from_file(sys.argv[1])
    simulation.run(steps, every=steps, progress=progress)

works = {
    "run": run,
    "progress": lambda: run(progress=progress),
    "case": lambda: emmy.Simulation(Case()),
    "path": lambda: emmy.Simulation.from_file(Path()),
}
sys.long_gone = LongGone()
signal.signal(signal.SIGINT, signal.default_int_handler)
thread = threading.Thread(
    target=works[sys.argv[2]], daemon=sys.argv[3] == "daemon")
thread.start()
time.sleep(0.3)
print("working", flush=True)
thread.join()
"""


@pytest.mark.parametrize("kind", ["daemon", "no daemon"])
@pytest.mark.parametrize(
    "work, seconds",
    [("run", 0), ("progress", 0), ("progress", 0.2), ("case", 0), ("path", 0)],
)
def test_ctrl_c_does_not_abort_a_process_with_a_working_thread(
    kind, work, seconds, examples
):
    with subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED, examples / "paper_box.json", work,
         kind, str(seconds)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    ) as process:
        errors = None
        try:
            assert process.stdout.readline() == "working\n"
            deadline = time.monotonic() + 60
            while errors is None and time.monotonic() < deadline:
                # Before join() it does not end the wait for such a thread.
                process.send_signal(signal.SIGINT)
                with contextlib.suppress(subprocess.TimeoutExpired):
                    errors = process.communicate(timeout=2)[1]
        finally:
            process.kill()
    assert process.returncode == -signal.SIGINT, errors
    assert "KeyboardInterrupt" in errors


def test_other_threads_go_on_during_a_run(box):
    simulation = emmy.Simulation(box)
    counter = 0
    done = threading.Event()

    def count():
        nonlocal counter
        while not done.is_set():
            counter += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    simulation.run(
        FOREVER, every=FOREVER,
        progress=lambda done_steps, total: counter < 20)
    done.set()
    thread.join()
    assert counter >= 20


def test_other_threads_go_on_while_a_case_is_read(box, tmp_path):
    box["rigid_bodies"] = [
        {**box["rigid_bodies"][0], "name": f"box{i}"} for i in range(10000)
    ]
    text = json.dumps(box)
    path = tmp_path / "boxes.json"
    path.write_text(text)
    done = threading.Event()
    ticks = []

    def tick():
        while not done.wait(0.001):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    spans = []
    for make, case in (
        (emmy.Simulation.from_file, path), (emmy.Simulation, text)
    ):
        start = time.monotonic()
        make(case)
        spans.append((start, time.monotonic()))
    done.set()
    thread.join()
    for start, end in spans:
        inside = [start, *(t for t in ticks if start < t < end), end]
        assert max(np.diff(inside)) < (end - start) / 2, (spans, len(inside))


def test_two_simulations_run_side_by_side(box):
    expected = emmy.Simulation(box).run().data
    simulations = [emmy.Simulation(box) for _ in range(2)]
    threads = [threading.Thread(target=s.run) for s in simulations]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for simulation in simulations:
        assert np.array_equal(simulation.history.data, expected)


def test_a_simulation_does_not_run_inside_itself(box):
    simulation = emmy.Simulation(box)
    with pytest.raises(RuntimeError, match="already running"):
        simulation.run(10, progress=lambda done, total: simulation.advance())
    simulation.advance()  # And is free again.
