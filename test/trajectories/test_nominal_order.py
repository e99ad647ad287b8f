"""The nominal response is the derivative of the nominal motion that the plant answers with."""

import math

import numpy as np
import pytest
from engine_runs import topics_of

from fpt_ros.cycle.trajectory_generator import TrajectoryGenerator
from fpt_ros.messages.frames import StateEstimate
from fpt_ros.trajectories import TRAJECTORIES

MS = 1_000_000
NAN = [math.nan]


PLAN = {
    "horizon.model": "duffing",
    "horizon.parameters": [0.8, 0.1, 0.9],
    "horizon.step": 0.05,
    "horizon.until": 2.0,
}
"""Of the motion that is optimised."""


SLIDE = """<mujoco><worldbody><body><joint name="x" type="slide" axis="0 0 1"/>
<geom size="0.1"/></body></worldbody></mujoco>"""


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    """A motion in a file, for those that read one."""
    path = tmp_path_factory.mktemp("motion") / "motion.csv"
    t = np.arange(0.0, 3.0, 0.1)
    np.savetxt(path, np.c_[t, np.sin(t) ** 3], delimiter=",", header="t [s],x", comments="")
    path.with_name("slide.xml").write_text(SLIDE)
    return str(path)


def generator(trajectory, relaxation, table):
    of_an_arm = trajectory == "cartesian_path"
    return TrajectoryGenerator(
        {
            **({"file": table} if trajectory == "recorded" else {}),
            **({"arm.file": table.replace("motion.csv", "slide.xml")} if of_an_arm else {}),
            **({"to_and_fro": False} if trajectory == "minimum_jerk" else {}),
            **(PLAN if trajectory == "receding_horizon" else {}),
            "trajectory": trajectory,
            "controlled": ["x"],
            "amplitude": [0.7],
            "frequency": [1.3],
            "lambda": 4.0,
            "error_relaxation": relaxation,
        }
    )


def motion(trajectory, relaxation, cycles, table):
    """Position, velocity and desired response of a plant that follows without any error."""
    follower, leader = (generator(trajectory, relaxation, table) for _ in range(2))
    rows = []
    for k in range(cycles):
        blind = StateEstimate(k * MS, ("x",), [0.0], [0.0], NAN, NAN)
        nominal = leader.step(blind)
        exact = StateEstimate(k * MS, ("x",), nominal.positions, nominal.velocities, NAN, NAN)
        desired = follower.step(exact)
        rows.append((desired.positions[0], desired.velocities[0], desired.accelerations[0]))
    return np.array(rows).T


@pytest.mark.parametrize("trajectory", TRAJECTORIES.names())
@pytest.mark.parametrize(("relaxation", "order"), [("value", 0), ("pi", 1), ("pd", 2), ("pid", 2)])
def test_every_motion_for_every_order(trajectory, relaxation, order, table):
    if trajectory == "cartesian_path":
        pytest.importorskip("mujoco")
    q, v, response = motion(trajectory, relaxation, 1500, table)
    expected = (q, np.gradient(q, 1e-3), np.gradient(np.gradient(q, 1e-3), 1e-3))[order]
    inner = slice(2, -2)
    integrated = len(TRAJECTORIES[trajectory].state) > 0

    def tolerance(x):
        """The spline's acceleration has corners; integration by Euler is exact to one step."""
        one_step = np.abs(np.diff(x)).max() if integrated else 0.0
        return 4e-3 * max(1.0, np.abs(x).max()) + one_step

    assert np.abs(response - expected)[inner].max() < tolerance(expected)
    assert np.abs(v - np.gradient(q, 1e-3))[inner].max() < tolerance(v)


def test_a_neuron_made_to_follow_a_sine_does_so():
    """With q'' in the place of q' the error was 0.6, of the size of the motion."""
    settings = ("trajectory_generator.trajectory=sine", "trajectory_generator.frequency=[0.2]")
    topics = topics_of("fitzhugh_nagumo", "adaptive", settings, duration=60.0)
    desired, measured = topics["desired"], topics["joint_states"]
    error = desired.column("positions", "v") - measured.column("position", "v")
    late = desired.time > 30.0
    assert np.sqrt(np.mean(error[late] ** 2)) < 0.03
