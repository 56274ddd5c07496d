"""Rigid bodies and trusses by the energy-momentum method.

    import emmy
    simulation = emmy.Simulation.from_file("examples/paper_box.json")
    history = simulation.run()
    history["time"], history["box.omega"]      # NumPy arrays, not copied
    simulation.energy.max_relative_error

A case is a file, JSON text or a dict of the same form: docs/case_format.md.
"""

from ._emmy import (
    BodyMotion,
    EnergyRecord,
    History,
    InputError,
    Invariants,
    LineMotion,
    MomentumRecord,
    PointMotion,
    Simulation,
    StepError,
    build_info,
)

__version__: str = build_info()["version"]

__all__ = [
    "BodyMotion",
    "EnergyRecord",
    "History",
    "InputError",
    "Invariants",
    "LineMotion",
    "MomentumRecord",
    "PointMotion",
    "Simulation",
    "StepError",
    "build_info",
]
