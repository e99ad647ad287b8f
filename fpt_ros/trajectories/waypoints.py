"""A motion through waypoints with the least jerk: see :mod:`fpt_ros.trajectories.quintic_pieces`.

``points`` holds the first waypoint of all coordinates, then the second, and so on.
"""

from itertools import pairwise

from fpt_ros.errors import BadInput
from fpt_ros.parameters import Parameter, Values, flag, numbers
from fpt_ros.trajectories import Trajectory, scales
from fpt_ros.trajectories.quintic_pieces import constants_of, nominal

PARAMETERS = (
    Parameter("times", "of the waypoints, ascending", [0.0, 1.0, 2.0], unit="s", minimum=0.0),
    Parameter(
        "points", "the waypoints, one after the other; empty: 0, 1, 0 of all coordinates", []
    ),
    Parameter("repeat", "begin anew behind the last one", False),
)


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants of the pieces.

    Raises:
        BadInput: times that do not ascend, or another number of points.
    """
    times, points = numbers(values, "times"), numbers(values, "points")
    if len(times) < 2 or any(b <= a for a, b in pairwise(times)):
        raise BadInput(
            "trajectory_generator.times: it takes two or more times that ascend, given are "
            f"{', '.join(f'{t:g}' for t in times) or 'none'}"
        )
    if not points and len(times) == 3:
        points = [0.0] * c + [1.0] * c + [0.0] * c
    if len(points) != c * len(times):
        raise BadInput(
            f"trajectory_generator.points: {len(points)} numbers given, {c * len(times)} needed: "
            f"{c} for each of the {len(times)} times"
        )
    each = [points[i::c] for i in range(c)]
    return constants_of(scales(values, c), flag(values, "repeat"), times, each)


WAYPOINTS = Trajectory(prepare, nominal, PARAMETERS)
