"""The nominal motion of a loop by itself: for checks and for the analysis of the iteration."""

from fpt_ros.cycle.trajectory_generator import TrajectoryGenerator

Motion = tuple[list[float], list[float], list[float]]
"""Position, velocity and response of each controlled coordinate."""


def sample(trajectory: TrajectoryGenerator, times: list[float], dt: float = 0.0) -> list[Motion]:
    """Nominal motion at some times [s]; one that is integrated needs all of them, dt [s] apart."""
    c, law, found = len(trajectory.controlled), trajectory.trajectory, []
    state = list(law.state)
    for i, t in enumerate(times):
        out = [0.0] * c, [0.0] * c, [0.0] * c
        law.nominal(trajectory.constants.nominal, state, t, dt if i else 0.0, *out)
        found.append((out[0], out[1], out[trajectory.relaxation.order]))
    return found
