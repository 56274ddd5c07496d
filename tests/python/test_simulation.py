"""Cases in, motion out: the same numbers as the program's."""
import csv
import json
import os
import subprocess

import numpy as np
import pytest

import emmy

PROGRAM = os.environ.get("EMMY_PROGRAM", "")


def test_dict_text_and_file_give_the_same_bits(box, tmp_path):
    path = tmp_path / "box.json"
    path.write_text(json.dumps(box))
    histories = [
        emmy.Simulation(box).run(),
        emmy.Simulation(json.dumps(box)).run(),
        emmy.Simulation.from_file(path).run(),
        emmy.Simulation.from_file(str(path)).run(),
    ]
    for history in histories[1:]:
        assert np.array_equal(history.data, histories[0].data)


def test_a_case_may_hold_numpy_values(box):
    plain = emmy.Simulation(box).run(10)
    body = box["rigid_bodies"][0]
    body["angular_velocity"] = np.array([0.3, 0.5, 0.8])
    body["penalty"] = np.float64(1e10)
    box["integrator"]["duration"] = np.int64(1)
    assert np.array_equal(emmy.Simulation(box).run(10).data, plain.data)


def test_overrides_replace_values(box):
    simulation = emmy.Simulation(
        box, overrides={"/integrator/time_step": 0.5, "/rigid_bodies/0/name": "top"}
    )
    assert simulation.time_step == 0.5
    assert simulation.bodies == ["top"]
    assert simulation.case["integrator"]["time_step"] == 0.5


def test_threads_change_no_bit(box):
    alone = emmy.Simulation(box).run(10)
    assert np.array_equal(emmy.Simulation(box, threads=2).run(10).data, alone.data)
    with pytest.raises(emmy.InputError, match="threads: must be .* >= 1, got 0"):
        emmy.Simulation(box, threads=0)


@pytest.mark.skipif(not PROGRAM, reason="EMMY_PROGRAM is not set")
@pytest.mark.parametrize("name", ["paper_box", "paper_truss", "double_pendulum"])
def test_history_is_that_of_the_program(name, examples, tmp_path):
    case = examples / f"{name}.json"
    subprocess.run(
        [PROGRAM, "run", case, "--output", tmp_path, "--steps", "55", "--quiet"],
        check=True,
    )
    with open(tmp_path / "history.csv", newline="") as file:
        header, *rows = csv.reader(file)
    history = emmy.Simulation.from_file(case).run(55)
    assert history.columns == header
    # 17 digits determine a double: equal, not close.
    assert np.array_equal(history.data, np.array(rows, dtype=float))


def test_invariants_hold_to_round_off(box):
    simulation = emmy.Simulation(box)
    # T = 1/2 omega . J omega of the box, by hand.
    assert simulation.invariants.total_energy == pytest.approx(7607.25, rel=1e-15)
    simulation.advance(1000)
    # Claimed for a million steps, with any penalty: 1e-14.
    assert 0 <= simulation.energy.max_relative_error < 1e-14
    assert 0 <= simulation.angular_momentum.max_relative_error < 1e-14
    assert simulation.momentum.max_error < 1e-14
    assert simulation.energy.conserved
    np.testing.assert_allclose(
        simulation.angular_momentum.initial, [2025, 6750, 14040], rtol=1e-15
    )
    assert simulation.invariants.kinetic_energy < 7607.25


def test_parts_are_observed_by_name(examples):
    simulation = emmy.Simulation.from_file(examples / "paper_truss.json")
    simulation.run(10)
    body = simulation.bodies[0]
    motion = simulation.body(body)
    assert motion.quaternion @ motion.quaternion == pytest.approx(1, rel=1e-14)
    row = simulation.history
    assert np.array_equal(row[f"{body}.omega"][-1], motion.omega)
    assert np.array_equal(row[f"{body}.position"][-1], motion.position)
    assert np.array_equal(row[f"{body}.quaternion"][-1], motion.quaternion)
    node, line = simulation.nodes[0], simulation.lines[0]
    assert np.array_equal(
        row[f"{node}.velocity"][-1], simulation.node(node).velocity
    )
    assert row[f"{line}.force"][-1] == simulation.line(line).force
    with pytest.raises(KeyError, match="there are"):
        simulation.body("nobody")
    with pytest.raises(KeyError, match="there are: step, time"):
        row["nothing"]


def test_a_run_goes_on_where_the_last_one_ended(box):
    whole = emmy.Simulation(box).run(20)
    simulation = emmy.Simulation(box)
    first = simulation.run(9)
    second = simulation.run(11)
    assert simulation.step == 20
    assert simulation.time == pytest.approx(0.02, rel=1e-15)
    # The last row of the first is the first row of the second.
    assert np.array_equal(first.data, whole.data[:10])
    assert np.array_equal(second.data, whole.data[9:])


def test_rows_are_start_every_nth_and_last(box):
    history = emmy.Simulation(box).run(25, every=10)
    assert history["step"].tolist() == [0, 10, 20, 25]
    assert len(history.data) == 4
    assert emmy.Simulation(box).run(0)["step"].tolist() == [0]


def test_version_and_build():
    assert emmy.__version__ == emmy.build_info()["version"]
    assert "-ffp-contract=off" in emmy.build_info()["flags"]
