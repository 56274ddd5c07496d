import pathlib

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture
def examples():
    return ROOT / "examples"


@pytest.fixture
def box():
    """The box of the paper as a dict, 1000 steps of 1 ms."""
    return {
        "format": "emmy-case/1",
        "name": "box",
        "rigid_bodies": [
            {
                "name": "box",
                "box": {"size": [3, 2, 1], "density": 2700},
                "penalty": 1e10,
                "angular_velocity": [0.3, 0.5, 0.8],
            }
        ],
        "integrator": {
            "method": "energy_momentum",
            "time_step": 1e-3,
            "duration": 1,
        },
    }
