"""The ideal neuron of section 3.1.2: the potential v of a FitzHugh-Nagumo model left to itself.

    v' = v - v^3 / 3 - w + I,   w' = (v + a - b w) / tau

from (0, 0), integrated by explicit Euler over the cycles, as the plant is.
"""

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.trajectories import Trajectory, scales

PARAMETERS = (
    Parameter("ideal.a", "recovery offset of the ideal neuron", 0.6),
    Parameter("ideal.tau", "recovery time constant of the ideal neuron", 11.0, above=0.0),
    Parameter("ideal.b", "recovery rate of the ideal neuron", 0.4),
    Parameter("ideal.I", "stimulus of the ideal neuron", 0.3),
)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: amplitude and frequency (factors), a, tau, b, I."""
    return (*scales(values, c), *(number(values, p.name) for p in PARAMETERS))


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """V, v' and v'' = v' - v^2 v' - w' at t; ``state`` is (v, w)."""
    scale, rate = constants[0], constants[1]
    a, tau, b, stimulus = constants[2], constants[3], constants[4], constants[5]
    v, w, h = state[0], state[1], rate * dt
    v_dot = v - v * v * v / 3.0 - w + stimulus
    w_dot = (v + a - b * w) / tau
    v, w = v + h * v_dot, w + h * w_dot
    state[0], state[1] = v, w
    v_dot = v - v * v * v / 3.0 - w + stimulus
    out_q[0] = scale * v
    out_v[0] = scale * rate * v_dot
    out_a[0] = scale * rate * rate * (v_dot - v * v * v_dot - (v + a - b * w) / tau)


FITZHUGH_NAGUMO = Trajectory(prepare, nominal, PARAMETERS, (0.0, 0.0))
