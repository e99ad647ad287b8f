"""A motion from a live topic: what anybody publishes, point by point, is followed.

The node writes each message into the parameters ``live.*``, which take effect at the next cycle and
are recorded with its stamp, as all changes in flight are: so ``fpt rerun`` and ``fpt replay`` have
the same motion again. Between two points the latest one is carried on::

    q = p + v age + a age^2 / 2,   age = time since it took effect

After ``hold_after`` without a new one the motion rests where it has come to. Before the first
point it rests at ``live.positions`` as they are configured.
"""

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number
from fpt_ros.trajectories import Trajectory, per_coordinate, scales

NUMBER, POSITIONS, VELOCITIES, ACCELERATIONS = (
    f"live.{name}" for name in ("number", "positions", "velocities", "accelerations")
)

KINDS = ("JointTrajectory", "JointState")

PARAMETERS = (
    Parameter("topic", "where the motion is published", "nominal_motion", live=False),
    Parameter(
        "message",
        "its type, trajectory_msgs/JointTrajectory (one point) or sensor_msgs/JointState",
        KINDS[0],
        choices=KINDS,
        live=False,
    ),
    Parameter(
        "hold_after", "time without a message after which it rests", 0.5, unit="s", above=0.0
    ),
    Parameter(NUMBER, "messages that have come", 0, minimum=0),
    Parameter(POSITIONS, "of the latest one; empty: zero", []),
    Parameter(VELOCITIES, "of the latest one; empty: zero", []),
    Parameter(ACCELERATIONS, "of the latest one; empty: zero", []),
)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants: c amplitudes, positions, velocities, accelerations; number, hold_after.

    Raises:
        BadInput: a list of another length.
    """
    point = [per_coordinate(values, name, c) for name in (POSITIONS, VELOCITIES, ACCELERATIONS)]
    moving = integer(values, NUMBER)
    return (
        *scales(values, c)[:c],
        *(x for each in point for x in each),
        float(moving),
        number(values, "hold_after"),
    )


def nominal(
    constants: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    out_q: MutableVector,
    out_v: MutableVector,
    out_a: MutableVector,
) -> None:
    """The latest point carried on; ``state``: its number and when it took effect."""
    c = len(out_q)
    latest, longest = constants[4 * c], constants[4 * c + 1]
    if state[0] != latest:
        state[0], state[1] = latest, t
    age = t - state[1]
    moves = latest > 0.0 and age <= longest
    age = min(age, longest) if latest > 0.0 else 0.0
    for i in range(c):
        scale, p = constants[i], constants[c + i]
        v, a = constants[2 * c + i], constants[3 * c + i]
        out_q[i] = scale * (p + age * (v + 0.5 * age * a))
        out_v[i] = scale * (v + age * a) if moves else 0.0
        out_a[i] = scale * a if moves else 0.0


LIVE = Trajectory(prepare, nominal, PARAMETERS, (0.0, 0.0))
