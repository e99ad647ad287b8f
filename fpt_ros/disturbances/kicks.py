"""Kicks: pulses a exp(-(t - t_k)^2 / (2 s_k^2)) at random times (the perturbations of RealAIGym).

Times, signs, sizes (up to ``amplitude``, a tenth of it at least) and widths follow from the seed of
the run; two kicks are ``apart`` seconds from each other at least.
"""

import math

from fpt_ros.disturbances import Disturbance, scales
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number

PARAMETERS = (
    Parameter("count", "how many", 3, minimum=0, maximum=1000),
    Parameter("apart", "least time between two", 1.0, unit="s", minimum=0.0),
    Parameter("narrowest", "least width s_k", 0.05, unit="s", above=0.0),
    Parameter("widest", "largest width s_k", 0.1, unit="s", above=0.0),
)


def prepare(values: Values, seed: int, cycles: int) -> tuple[float, ...]:
    """Constants: amplitude, frequency, then time, width and size (-1 to 1) of each kick.

    Raises:
        BadInput: they do not fit into the run.
    """
    import numpy as np

    count, apart = (integer(values, "disturbance.count"), number(values, "disturbance.apart"))
    length = cycles * number(values, "dt")
    free = length - apart * max(count - 1, 0)
    if count and free <= 0.0:
        raise BadInput(
            f"plant_simulator.disturbance.count: {count} kicks {apart:g} s apart do not fit into "
            f"{length:g} s"
        )
    random = np.random.default_rng((seed, count))
    times = np.sort(random.uniform(0.0, free, count)) + apart * np.arange(count)
    low, high = (number(values, f"disturbance.{name}") for name in ("narrowest", "widest"))
    widths = random.uniform(min(low, high), max(low, high), count)
    sizes = random.uniform(0.1, 1.0, count) * random.choice((-1.0, 1.0), count)
    kicks = np.column_stack((times, widths, sizes)).ravel().tolist()
    return (*scales(values, seed, cycles), *kicks)


def force(constants: Vector, state: MutableVector, t: float, h: float, q: float, v: float) -> float:
    """Force at t [s]; ``frequency`` is a factor of time."""
    total = 0.0
    for k in range(2, len(constants), 3):
        x = (constants[1] * t - constants[k]) / constants[k + 1]
        total += constants[k + 2] * math.exp(-0.5 * x * x)
    return constants[0] * total


KICKS = Disturbance(prepare, force, PARAMETERS)
