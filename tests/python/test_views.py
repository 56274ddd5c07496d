"""Arrays show the library's memory: no copy, no dangling, no writing."""
import gc
import weakref
from collections.abc import Mapping

import numpy as np
import pytest

import emmy


def address(array):
    return array.__array_interface__["data"][0]


@pytest.mark.parametrize("order", [2, 4])
def test_state_vectors_are_one_memory_that_moves_with_the_steps(box, order):
    box["integrator"]["order"] = order
    simulation = emmy.Simulation(box)
    for name in ("position", "velocity", "strain"):
        view = getattr(simulation, name)
        before, place = view.copy(), address(view)
        simulation.advance(3)
        assert address(getattr(simulation, name)) == place
        assert not np.array_equal(view, before)


def test_state_vectors_stay_in_place_when_a_step_fails(box):
    # Composed steps put back the start of the step.
    box["integrator"]["order"] = 4
    box["rigid_bodies"][0]["penalty"] = 1e-3
    simulation = emmy.Simulation(box, overrides={"/integrator/time_step": 1e9})
    view = simulation.velocity
    before = view.copy()
    with pytest.raises(emmy.StepError):
        simulation.advance(1)
    assert simulation.step == 0
    assert address(simulation.velocity) == address(view)
    assert np.array_equal(view, before)


def test_views_cannot_be_written(box):
    simulation = emmy.Simulation(box)
    history = simulation.run(2)
    for view in (simulation.position, history.data, history["box.omega"]):
        assert not view.flags.owndata
        with pytest.raises(ValueError):
            view[0] = 1.0


def test_views_of_a_history_share_one_table(box):
    history = emmy.Simulation(box).run(5)
    assert history.data.shape == (6, len(history.columns))
    time, omega = history["time"], history["box.omega"]
    assert np.shares_memory(time, history.data)
    assert np.shares_memory(omega, history.data)
    assert omega.shape == (6, 3)
    column = history.columns.index("box.omega_y")
    assert np.array_equal(omega[:, 1], history.data[:, column])
    assert history["box.quaternion"].shape == (6, 4)
    assert history["box.quaternion_w"].shape == (6,)


def test_a_history_is_a_mapping_from_columns_to_views(box):
    history = emmy.Simulation(box).run(5)
    assert isinstance(history, Mapping)
    assert list(history) == list(history.keys()) == history.columns
    assert len(history) == len(history.columns)
    columns = dict(history)
    assert list(columns) == history.columns
    for values in columns, dict(history.items()):
        assert all(
            np.shares_memory(values[name], history.data) for name in history)
    assert len(list(history.values())) == len(history)
    assert history.get("time") is not None
    assert history.get("nothing", 3) == 3


def test_what_is_in_a_history_can_be_looked_up(box):
    history = emmy.Simulation(box).run(1)
    for name in ("time", "box.omega_x", "box.omega", "box.quaternion"):
        assert name in history
        assert history[name].shape[0] == 2
    for name in ("tim", "box", "box.omega_w", "", "\udce9", 3, None):
        assert name not in history


def test_a_view_keeps_its_owner_alive(box):
    simulation = emmy.Simulation(box)
    position = simulation.position
    expected = position.copy()
    history = simulation.run(0)
    data = history.data
    del simulation, history
    gc.collect()
    filler = [np.full(12, 7.0) for _ in range(1000)]  # Would reuse the memory.
    assert np.array_equal(position, expected)
    assert data.shape[0] == 1
    assert position.base is not None and len(filler) == 1000


def test_nothing_is_kept_for_ever(box):
    class Case(dict):
        pass

    case = Case(box)
    simulation = emmy.Simulation(case)
    simulation.run(1, progress=lambda done, total: None)
    reference = weakref.ref(case)
    del case
    gc.collect()
    assert reference() is None
