"""What goes wrong arrives as an exception, in the program's words."""
import json
import math
import os
import pathlib
import subprocess
import sys

import pytest

import emmy

PROGRAM = os.environ.get("EMMY_PROGRAM", "")


def test_kinds():
    assert issubclass(emmy.InputError, ValueError)
    assert issubclass(emmy.StepError, RuntimeError)
    assert emmy.InputError.__module__ == "emmy"


@pytest.mark.parametrize(
    "pointer, value, message",
    [
        ("/rigid_bodies/0/box/density", -2700,
         "/rigid_bodies/0/box/density: must be a finite number > 0 [kg/m^3], "
         "got -2700"),
        ("/integrator/time_step", 0, "/integrator/time_step: must be"),
        ("/integrator/order", 3, "/integrator/order: must be 2, 4 or 6"),
        ("/rigid_bodies/0/box/densty", 1, "did you mean density?"),
    ],
)
def test_bad_values(box, pointer, value, message):
    with pytest.raises(emmy.InputError) as caught:
        emmy.Simulation(box, overrides={pointer: value})
    assert message in str(caught.value)


@pytest.mark.skipif(not PROGRAM, reason="EMMY_PROGRAM is not set")
@pytest.mark.parametrize(
    "text", ['{"format": "emmy-case/1"', '{"format": "emmy-case/9"}', "[]", ""]
)
def test_messages_of_a_file_are_the_programs(text, tmp_path):
    path = tmp_path / "case.json"
    path.write_text(text)
    program = subprocess.run(
        [PROGRAM, "run", path], capture_output=True, text=True, check=False
    )
    assert program.returncode == 2
    with pytest.raises(emmy.InputError) as caught:
        emmy.Simulation.from_file(path)
    assert str(caught.value) == program.stderr.rstrip("\n")


@pytest.mark.skipif(not PROGRAM, reason="EMMY_PROGRAM is not set")
def test_message_of_a_failed_step_is_the_programs(examples):
    case = examples / "paper_box.json"
    overrides = {"/integrator/time_step": 1e9, "/integrator/duration": 1e10,
                 "/rigid_bodies/0/penalty": 1e-3}
    program = subprocess.run(
        [PROGRAM, "run", case, "--quiet",
         *(f"--set={name}={value}" for name, value in overrides.items())],
        capture_output=True, text=True, check=False)
    assert program.returncode == 1
    simulation = emmy.Simulation.from_file(case, overrides=overrides)
    with pytest.raises(emmy.StepError) as caught:
        simulation.run()
    assert str(caught.value) == program.stderr.rstrip("\n")
    # Up to the last good step, which is the start.
    assert simulation.step == 0
    assert simulation.history["step"].tolist() == [0]


def test_files_that_cannot_be_read(tmp_path):
    for path in (tmp_path, tmp_path / "missing.json"):
        with pytest.raises(emmy.InputError, match=str(path)):
            emmy.Simulation.from_file(path)


def test_names_of_files_may_be_any_bytes(box, tmp_path):
    path = os.fsencode(tmp_path) + b"/caf\xe9.json"
    try:
        with open(path, "w") as file:
            json.dump(box, file)
    except OSError:
        pytest.skip("this file system has no such names")
    for name in (path, os.fsdecode(path), pathlib.Path(os.fsdecode(path))):
        assert emmy.Simulation.from_file(name).name == "box"
    with pytest.raises(emmy.InputError) as caught:
        emmy.Simulation.from_file(path, overrides={"/integrator/order": 3})
    assert str(caught.value).startswith(os.fsdecode(path) + ": /integrator/order")


def test_names_that_no_file_can_have():
    with pytest.raises(ValueError, match="null byte"):
        emmy.Simulation.from_file("case\0.json")
    with pytest.raises(TypeError, match="int"):
        emmy.Simulation.from_file(3)


@pytest.mark.parametrize(
    "changes, overrides, place",
    [
        ({"purpose": "caf\udce9"}, {}, "/purpose"),
        ({"nodes": [{"caf\udce9": 1}]}, {}, "/nodes/0"),
        ({}, {"/purpose": "caf\udce9"}, "/purpose"),
        ({}, {"/caf\udce9": 1}, "overrides"),
    ],
)
def test_text_that_is_not_unicode(box, changes, overrides, place):
    with pytest.raises(emmy.InputError) as caught:
        emmy.Simulation({**box, **changes}, overrides=overrides)
    assert str(caught.value).startswith(f"{place}: must be Unicode text, got ")
    assert str(caught.value).isascii()


def test_json_text_that_is_not_unicode():
    with pytest.raises(
        emmy.InputError,
        match=r"^case: must be Unicode text, got '\\udce9' at position 4$",
    ):
        emmy.Simulation('"caf\udce9"')


@pytest.mark.parametrize("number", [math.nan, math.inf])
def test_numbers_that_json_has_not(box, number):
    box["rigid_bodies"][0]["box"]["density"] = number
    with pytest.raises(
        emmy.InputError,
        match="^/rigid_bodies/0/box/density: must be a finite number, got",
    ):
        emmy.Simulation(box)


def test_values_that_json_has_not(box):
    box["purpose"] = {1, 2}
    with pytest.raises(emmy.InputError, match="^/purpose: must be a value.*set"):
        emmy.Simulation(box)
    with pytest.raises(TypeError, match="from_file"):
        emmy.Simulation(3)


OUT_OF_MEMORY = """
import resource, sys
import emmy
simulation = emmy.Simulation.from_file(sys.argv[1])
first = simulation.run(1)
with open("/proc/self/statm") as statm:
    used = int(statm.read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + 2**26, used + 2**26))
try:
    simulation.run(10**12, every=1)
except MemoryError:
    steps = simulation.history["step"]
    assert simulation.history is not first
    assert steps[0] == 1 and len(steps) > 1000, steps
    # Its row is the one for which there was no memory.
    assert steps[-1] == simulation.step - 1, (steps, simulation.step)
    print("out of memory")
"""


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="no /proc")
def test_history_has_the_rows_for_which_there_was_memory(examples):
    result = subprocess.run(
        [sys.executable, "-c", OUT_OF_MEMORY, examples / "paper_box.json"],
        capture_output=True, text=True, check=False, timeout=100)
    assert result.stdout == "out of memory\n", result.stderr


def test_progress_that_cannot_be_called(box):
    simulation = emmy.Simulation(box)
    with pytest.raises(TypeError, match="progress: must be callable, got int"):
        simulation.run(10, progress=3)
    assert simulation.step == 0
    assert simulation.history is None


def test_counts_out_of_range(box):
    simulation = emmy.Simulation(box)
    with pytest.raises(emmy.InputError, match="steps: .*-1"):
        simulation.run(-1)
    with pytest.raises(emmy.InputError, match="every: .*0"):
        simulation.run(1, every=0)
    with pytest.raises(TypeError):
        simulation.run(1.5)


def test_a_body_that_turns_inside_out_ends_the_run_at_the_last_good_step(box):
    sim = emmy.Simulation(box, overrides={
        "/rigid_bodies/0/penalty": 1, "/integrator/time_step": 1})
    with pytest.raises(emmy.StepError, match="turned inside out") as caught:
        sim.run(100, every=1)
    assert f"step {sim.step + 1} at t = {sim.step} s" in str(caught.value)
    assert sim.history["step"][-1] == sim.step
