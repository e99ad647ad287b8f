"""The momentum observer of robot arms (De Luca and Mattone 2003), on the approximate model.

With the momentum p = M q' and an observer of gain k_o [1/s]::

    z' = tau + M' q' - h + d,   d = k_o (p - z)

d follows the effort of disturbance and model error, to which it is a first order low pass; it is
taken away. In cycles, with the observed response a as the difference of the velocities, p - z grows
by dt (M a + h - tau - d)::

    d <- d + k_o dt (explained - effort - d)

which is the disturbance observer with forward Euler in the place of the exact low pass.
"""

from fpt_ros.compensators import Compensator
from fpt_ros.compensators.disturbance_observer import compensate, memory
from fpt_ros.errors import BadInput
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (Parameter("gain", "k_o of the observer", 300.0, unit="1/s", above=0.0),)


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants (k_o dt,).

    Raises:
        BadInput: the observer itself is unstable.
    """
    gain = number(values, "compensator.gain")
    if not gain * dt < 2.0:
        raise BadInput(
            f"fpt_deformer.compensator.gain: {gain:g} 1/s is unstable in cycles of {dt:g} s, it "
            f"takes less than {2.0 / dt:g}"
        )
    return (gain * dt,)


MOMENTUM_OBSERVER = Compensator(prepare, compensate, memory, PARAMETERS)
