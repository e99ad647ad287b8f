"""Observer of the neuron's recovery variable, of which only the potential v is measured (3.1.2).

    w~' = (v + a - b w~) / tau,   w~(0) = 0

with the approximate parameters, by explicit Euler: where w is not measured, it takes its place.
"""

from fpt_ros.denoising.streaming import Filter
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (
    Parameter("approximate.a", "recovery offset of the approximate model"),
    Parameter("approximate.tau", "recovery time constant of the approximate model", above=0.0),
    Parameter("approximate.b", "recovery rate of the approximate model"),
)


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants (a, tau, b)."""
    return tuple(number(values, p.name) for p in PARAMETERS)


def state_size(constants: Vector, n: int) -> int:
    """The last v, and w~."""
    return 2


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """Begin with w~ = 0."""
    state[0] = q[0]
    state[1] = 0.0


def update(
    constants: Vector,
    state: MutableVector,
    dt: float,
    q: Vector,
    v: Vector,
    out_q: MutableVector,
    out_v: MutableVector,
    out_response: MutableVector,
) -> None:
    """Measured v with its backward difference; w~ and its rate."""
    a, tau, b = constants[0], constants[1], constants[2]
    rate = (state[0] + a - b * state[1]) / tau
    out_q[0], out_q[1] = q[0], state[1] + dt * rate
    out_response[0], out_response[1] = (q[0] - state[0]) / dt, rate
    out_v[0], out_v[1] = out_response[0], out_response[1]
    state[0], state[1] = q[0], out_q[1]


FITZHUGH_NAGUMO_OBSERVER = Filter(prepare, state_size, start, update, PARAMETERS)
