"""LuGre friction (thesis, section 2.4.6: at axle 3): Stribeck curve and bristles.

    G = Fc + (Fs - Fc) exp(-(v / vs)^2),   z' = v - sigma0 |v| z / G
    F = -amplitude (sigma0 z + sigma1 z' + sigma2 v)

z is stiff: its step is implicit in z and explicit in v.
"""

import math

from fpt_ros.disturbances import Disturbance, scales
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (
    Parameter("sigma0", "stiffness of the bristles", 1e5, unit="N/m", above=0.0),
    Parameter("sigma1", "damping of the bristles", 300.0, unit="N s/m", minimum=0.0),
    Parameter("sigma2", "viscous friction", 2.0, unit="N s/m", minimum=0.0),
    Parameter("coulomb", "Coulomb friction Fc", 40.0, unit="N", above=0.0),
    Parameter("static", "static friction Fs", 60.0, unit="N", above=0.0),
    Parameter("stribeck", "Stribeck velocity vs", 0.05, unit="m/s", above=0.0),
)


def prepare(values: Values, seed: int, cycles: int) -> tuple[float, ...]:
    """Constants (amplitude, frequency, sigma0, sigma1, sigma2, Fc, Fs, vs)."""
    own = tuple(number(values, f"disturbance.{p.name}") for p in PARAMETERS)
    return (*scales(values, seed, cycles), *own)


def force(constants: Vector, state: MutableVector, t: float, h: float, q: float, v: float) -> float:
    """Friction force at the bristles' deflection z = state[0], which is then advanced."""
    sigma0, sigma1, sigma2 = constants[2], constants[3], constants[4]
    coulomb, static, x = constants[5], constants[6], v / constants[7]
    G = coulomb + (static - coulomb) * math.exp(-(x * x))
    z, size = state[0], abs(v)
    z_dot = v - sigma0 * size * z / G
    state[0] = (z + h * v) / (1.0 + h * sigma0 * size / G)
    return -constants[0] * (sigma0 * z + sigma1 * z_dot + sigma2 * v)


LUGRE = Disturbance(prepare, force, PARAMETERS, 1)
