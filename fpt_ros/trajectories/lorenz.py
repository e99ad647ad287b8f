"""A Lorenz system left to itself (Lorenz 1963): the one that another is to synchronise with.

    x' = sigma (y - x),   y' = x (rho - z) - y,   z' = x y - beta z

integrated by explicit Euler over the cycles, as the plant is. With fewer than three coordinates
the first ones are followed.
"""

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.trajectories import Trajectory, scales

PARAMETERS = (
    Parameter("drive.sigma", "Prandtl number of the drive", 10.0),
    Parameter("drive.beta", "geometry of its cell", 8.0 / 3.0),
    Parameter("drive.rho", "its Rayleigh number over the critical one", 28.0),
)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: amplitudes and frequencies (factors; time has the first one), sigma, beta, rho."""
    return (*scales(values, c), *(number(values, p.name) for p in PARAMETERS))


def rate(constants: Vector, at: int, k: int, x: float, y: float, z: float) -> float:
    """First derivative of a coordinate."""
    if k == 0:
        return constants[at] * (y - x)
    if k == 1:
        return x * (constants[at + 2] - z) - y
    return x * y - constants[at + 1] * z


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """Position, rate and its derivative; ``state`` is (x, y, z)."""
    c = len(out_q)
    at, w = 2 * c, constants[c]
    sigma, beta, rho = constants[at], constants[at + 1], constants[at + 2]
    x, y, z = state[0], state[1], state[2]
    h = w * dt
    x, y, z = (
        x + h * rate(constants, at, 0, x, y, z),
        y + h * rate(constants, at, 1, x, y, z),
        z + h * rate(constants, at, 2, x, y, z),
    )
    state[0], state[1], state[2] = x, y, z
    x_dot, y_dot, z_dot = (
        rate(constants, at, 0, x, y, z),
        rate(constants, at, 1, x, y, z),
        rate(constants, at, 2, x, y, z),
    )
    for i in range(c):
        a = constants[i]
        if i == 0:
            q, v, second = x, x_dot, sigma * (y_dot - x_dot)
        elif i == 1:
            q, v, second = y, y_dot, x_dot * (rho - z) - x * z_dot - y_dot
        else:
            q, v, second = z, z_dot, x_dot * y + x * y_dot - beta * z_dot
        out_q[i], out_v[i], out_a[i] = a * q, a * w * v, a * w * w * second


LORENZ = Trajectory(prepare, nominal, PARAMETERS, (1.0, 1.0, 1.0))
