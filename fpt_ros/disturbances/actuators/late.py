"""Commands that come late: what acts is the command of some cycles ago.

Each command by itself is late with a probability; one that has been overtaken does not act any
more, so a late command means that the last one in time acts on.
"""

from fpt_ros.disturbances.actuators import ActuatorDisturbance
from fpt_ros.disturbances.chance import uniform
from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number

MOST = 64
"""Cycles that a command may be late."""

PARAMETERS = (
    Parameter("cycles", "how late a command is", 1, minimum=1, maximum=MOST),
    Parameter("probability", "that a command is late", 1.0, minimum=0.0, maximum=1.0),
)


def prepare(values: Values, first: float) -> tuple[float, ...]:
    """Constants (first, cycles, probability)."""
    return first, float(integer(values, "cycles")), number(values, "probability")


def actuate(
    constants: Vector, state: MutableVector, dt: float, where: Indices, effort: MutableVector
) -> None:
    """state: of chance; count of cycles; of the command that acts its cycle + 1, 0 before one came.

    Then rings of MOST + 1 cycles: when the command of a cycle arrives, and n of efforts.
    """
    late, ring, now = int(constants[1]), MOST + 1, int(state[1])
    delay = late if uniform(state, constants[0]) < constants[2] else 0
    state[3 + now % ring] = float(now + delay)
    n = (len(state) - 3 - ring) // ring
    for i in range(n):
        state[3 + ring + i * ring + now % ring] = effort[i]
    acting = int(state[2]) - 1
    sent = now
    while sent > acting and state[3 + sent % ring] > now:
        sent -= 1
    for k in range(len(where)):
        i = where[k]
        effort[i] = state[3 + ring + i * ring + sent % ring] if sent >= 0 else 0.0
    state[1], state[2] = float(now + 1), float(sent + 1)


LATE = ActuatorDisturbance(prepare, actuate, PARAMETERS, lambda n: 3 + (MOST + 1) * (1 + n))
"""Up to the first command that has come nothing acts."""
