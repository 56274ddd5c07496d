"""SI units. Arrays named a view show memory of the library in place: they cost
nothing, cannot be written to, and keep their owner alive."""

import os
from typing import Any, Callable, Iterator, Mapping, Optional, TypedDict, Union

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]
_Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]

class InputError(ValueError):
    """A case that cannot be used; the message names the place, what was
    expected and what was found, as that of the program `emmy`."""

class StepError(RuntimeError):
    """A step that could not be computed, or whose state is no result: energy or
    momentum is not finite, or a body has turned inside out. The simulation and
    its history end with the last good step."""

class _BuildInfo(TypedDict):
    version: str
    compiler: str
    flags: str

def build_info() -> _BuildInfo:
    """How the library was built: rounding errors belong to a build."""

class History(Mapping[str, _Array]):
    """The rows of one run, as a mapping from the columns of history.csv
    (docs/case_format.md) to their values: dict(history), "time" in history.
    len(history.data) is the number of rows."""

    @property
    def columns(self) -> list[str]: ...
    @property
    def data(self) -> _Array:
        """View, a row per recorded step."""
    def __getitem__(self, name: str) -> _Array:
        """View of one column ("time", "box.omega_x"), or of the components of
        a vector or quaternion side by side ("box.omega": rows by 3), a name
        that is in the history but not among its keys."""
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...

class Invariants:
    """[J], [kg m/s], [kg m^2/s], measured in extended precision and rounded
    once; angular momentum about the inertial origin."""

    @property
    def kinetic_energy(self) -> float: ...
    @property
    def penalty_energy(self) -> float: ...
    @property
    def elastic_energy(self) -> float: ...
    @property
    def gravity_energy(self) -> float: ...
    @property
    def load_work(self) -> float: ...
    @property
    def internal_energy(self) -> float:
        """Kinetic + penalty + elastic: the scale of energy errors."""
    @property
    def total_energy(self) -> float:
        """Internal + gravity energy - work of loads: constant in every case."""
    @property
    def momentum(self) -> _Array: ...
    @property
    def angular_momentum(self) -> _Array: ...

class EnergyRecord:
    """Total energy over every step since the start [J]."""

    @property
    def initial(self) -> float: ...
    @property
    def final(self) -> float: ...
    @property
    def max_error(self) -> float: ...
    @property
    def scale(self) -> float: ...
    @property
    def max_relative_error(self) -> float: ...
    @property
    def conserved(self) -> bool:
        """Whether the model keeps this quantity at all."""

class MomentumRecord:
    """A momentum over every step since the start; errors are norms."""

    @property
    def initial(self) -> _Array: ...
    @property
    def final(self) -> _Array: ...
    @property
    def max_error(self) -> float: ...
    @property
    def scale(self) -> float: ...
    @property
    def max_relative_error(self) -> float: ...
    @property
    def conserved(self) -> bool: ...

class BodyMotion:
    """Inertial frame. Angular velocities [rad/s] are those of docs/theory.md:
    locked (ATT-4), polar (ATT-2) and exact polar (ATT-3)."""

    @property
    def position(self) -> _Array: ...
    @property
    def velocity(self) -> _Array: ...
    @property
    def quaternion(self) -> _Array:
        """(w, x, y, z) of unit length, w >= 0."""
    @property
    def omega(self) -> _Array: ...
    @property
    def omega_polar(self) -> _Array: ...
    @property
    def omega_polar_exact(self) -> _Array: ...

class PointMotion:
    @property
    def position(self) -> _Array: ...
    @property
    def velocity(self) -> _Array: ...

class LineMotion:
    @property
    def strain(self) -> float: ...
    @property
    def force(self) -> float:
        """[N], tension positive."""

class Simulation:
    """A model, its state and the integrator, from a case.

    Simulations are independent: several may run in threads of their own. One
    simulation is for one thread at a time.
    """

    def __init__(
        self,
        case: Union[Mapping[str, Any], str],
        *,
        overrides: Optional[Mapping[str, Any]] = None,
        threads: int = 1,
    ) -> None:
        """`case` is a dict in the form of a case file, or JSON text; vectors
        may be lists or NumPy arrays. `overrides` replaces values by their JSON
        pointers: {"/integrator/time_step": 1e-4}. `threads` share the steps of
        large nets and long chains; results do not depend on it."""
    @staticmethod
    def from_file(
        path: _Path,
        *,
        overrides: Optional[Mapping[str, Any]] = None,
        threads: int = 1,
    ) -> "Simulation":
        """The same from a case file; messages of errors begin with `path`."""
    def run(
        self,
        steps: Optional[int] = None,
        *,
        every: Optional[int] = None,
        progress: Optional[Callable[[int, int], object]] = None,
    ) -> History:
        """Goes on from the present state and returns what it recorded: the
        present state, every step whose number `every` divides, the last one.

        Without `steps` and `every` it takes those of the case. Calls
        progress(steps done, steps in all) at most ten times a second and after
        the last step: None goes on, and so does anything else that is true;
        False, 0 or numpy.False_ ends the run. Ctrl-C ends it with
        KeyboardInterrupt. However it ends, `history` has the rows so far.
        """
    def advance(self, steps: int = 1) -> None:
        """Goes on without recording; invariants are followed all the same."""
    @property
    def history(self) -> Optional[History]:
        """Of the last call of run()."""
    @property
    def case(self) -> dict[str, Any]:
        """The case with its defaults filled in, except lengths of trusses."""
    @property
    def name(self) -> str: ...
    @property
    def bodies(self) -> list[str]: ...
    @property
    def nodes(self) -> list[str]: ...
    @property
    def lines(self) -> list[str]:
        """Trusses, then springs."""
    @property
    def degrees_of_freedom(self) -> int: ...
    @property
    def time_step(self) -> float: ...
    @property
    def step(self) -> int: ...
    @property
    def time(self) -> float: ...
    @property
    def position(self) -> _Array:
        """View of all coordinates; changes with each step."""
    @property
    def velocity(self) -> _Array:
        """View, like `position`."""
    @property
    def strain(self) -> _Array:
        """View, like `position`."""
    def body(self, name: str) -> BodyMotion:
        """Of the present state, as all that is observed here."""
    def node(self, name: str) -> PointMotion:
        """Of one of `nodes`."""
    def line(self, name: str) -> LineMotion:
        """Of one of `lines`."""
    @property
    def invariants(self) -> Invariants: ...
    @property
    def energy(self) -> EnergyRecord: ...
    @property
    def momentum(self) -> MomentumRecord: ...
    @property
    def angular_momentum(self) -> MomentumRecord: ...
