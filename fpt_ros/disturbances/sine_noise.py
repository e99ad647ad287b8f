"""A sine with uniform noise on it: the disturbance of the neuron (thesis, section 3.1.2).

    y(t) = a sin(w t) + z_k,   z_k uniform in [-noise, noise), one number per cycle

The numbers are drawn at once, with the seed of the run; after ``MOST`` cycles they come again.
"""

import math

from fpt_ros.disturbances import Disturbance, scales
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

MOST = 1_000_000
"""Numbers that are drawn at most: a run of any length has the same memory."""

PARAMETERS = (Parameter("noise", "half width of the uniform noise", 0.15, minimum=0.0),)


def prepare(values: Values, seed: int, cycles: int) -> tuple[float, ...]:
    """Constants: amplitude, frequency [rad/s], cycles per second, then the noise of each cycle."""
    import numpy as np

    half = number(values, "disturbance.noise")
    noise = np.random.default_rng(seed).uniform(-half, half, min(cycles, MOST)).tolist()
    return (*scales(values, seed, cycles), 1.0 / number(values, "dt"), *noise)


def force(constants: Vector, state: MutableVector, t: float, h: float, q: float, v: float) -> float:
    """Force at t [s]; the amplitude scales the sine, not the noise."""
    cycle = int(t * constants[2] + 0.5) % (len(constants) - 3)
    return constants[0] * math.sin(constants[1] * t) + constants[3 + cycle]


SINE_NOISE = Disturbance(prepare, force, PARAMETERS)
