"""q^N(t) = offset before a step, offset + amplitude behind it; all derivatives are zero.

The step is at ``at`` / frequency. What the relaxation does with it is its step response.
"""

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.trajectories import Trajectory, per_coordinate, scales

PARAMETERS = (
    Parameter("offset", "before the step, per coordinate; empty: zero", []),
    Parameter("at", "time of the step, for a frequency of 1", 0.0, unit="s", minimum=0.0),
)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: amplitudes, frequencies, offsets, c each; the time of the step [s]."""
    return (*scales(values, c), *per_coordinate(values, "offset", c), number(values, "at"))


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """One of two places, at rest."""
    c = len(out_q)
    for i in range(c):
        passed = constants[c + i] * t >= constants[3 * c]
        out_q[i] = constants[2 * c + i] + (constants[i] if passed else 0.0)
        out_v[i], out_a[i] = 0.0, 0.0


STEP = Trajectory(prepare, nominal, PARAMETERS)
