"""Step, chirp, minimum jerk, waypoints and motions from files, against closed forms and SciPy."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import minimize

from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import load
from fpt_ros.trajectories import TRAJECTORIES


def law(name, c=1, amplitude=1.0, frequency=1.0, **values):
    motion = TRAJECTORIES[name]
    own = {p.name: p.default for p in motion.parameters}
    own |= {"amplitude": [amplitude] * c, "frequency": [frequency] * c, **values}
    constants = motion.prepare(own, c)

    def at(t):
        out = [0.0] * c, [0.0] * c, [0.0] * c
        motion.nominal(constants, [], t, 0.001, *out)
        return out

    return at


def test_a_step_is_where_it_is_told():
    at = law("step", amplitude=2.0, offset=[1.0], at=0.5)
    assert [at(t)[0][0] for t in (0.0, 0.499, 0.5, 3.0)] == [1.0, 1.0, 3.0, 3.0]
    assert at(0.5)[1:] == ([0.0], [0.0])


def test_the_frequency_of_a_chirp_rises_linearly_and_stays():
    at = law("chirp", frequency=2.0, last_frequency=[20.0], sweep=5.0)
    for t in (0.3, 2.0, 4.9, 7.0):
        phase = quad(lambda x: 2.0 + 18.0 * min(x / 5.0, 1.0), 0.0, t, points=[5.0])[0]
        q, v, _ = at(t)
        assert q[0] == pytest.approx(math.sin(phase), abs=1e-9)
        rate = 2.0 + 18.0 * min(t / 5.0, 1.0)
        assert v[0] == pytest.approx(rate * math.cos(phase), abs=1e-7)


def test_minimum_jerk_goes_to_and_fro_with_pauses():
    at = law("minimum_jerk", amplitude=2.0, frequency=0.5, pause=0.5, offset=[1.0])
    assert [at(t)[0][0] for t in (0.0, 0.9, 3.0, 3.9, 6.0)] == pytest.approx([1, 1, 3, 3, 1])
    assert at(2.0)[0][0] == pytest.approx(2.0)  # the middle of a move
    assert at(2.0)[1][0] == pytest.approx(2.0 * 0.5 * 1.875)  # Flash and Hogan: 15/8 of the mean
    once = law("minimum_jerk", to_and_fro=False)
    assert once(50.0) == ([1.0], [0.0], [0.0])


def jerk_of(times, points):
    """Integral of the squared jerk of a motion through waypoints, by differences."""
    at = law("waypoints", times=times, points=points)
    t = np.linspace(times[0], times[-1], 4001)
    a = np.array([at(x)[2][0] for x in t])
    return np.sum(np.diff(a) ** 2) / (t[1] - t[0])


def test_waypoints_are_met_at_rest_at_both_ends_and_with_the_least_jerk():
    times, points = [0.0, 0.7, 1.5, 2.0], [0.0, 1.0, -0.5, 0.3]
    at = law("waypoints", times=times, points=points)
    assert [at(t)[0][0] for t in times] == pytest.approx(points, abs=1e-12)
    assert [at(0.0)[k][0] for k in (1, 2)] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert [at(2.0)[k][0] for k in (1, 2)] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert at(5.0) == ([pytest.approx(0.3)], [0.0], [0.0])

    # a free point between two others: the spline through three puts it where the jerk is least
    def cost(x):
        return jerk_of([0.0, 0.7, 1.1, 1.5, 2.0], [0.0, 1.0, float(x[0]), -0.5, 0.3])

    free = minimize(cost, [0.0], method="Nelder-Mead", options={"xatol": 1e-7}).x[0]
    assert at(1.1)[0][0] == pytest.approx(free, abs=1e-3)


def test_one_piece_of_waypoints_is_the_minimum_jerk_motion():
    at = law("waypoints", times=[0.0, 1.0], points=[0.0, 1.0])
    jerk = law("minimum_jerk", to_and_fro=False)
    for t in (0.1, 0.5, 0.83):
        for x, y in zip(at(t), jerk(t), strict=True):
            assert x == pytest.approx(y, abs=1e-9)


def test_two_coordinates_and_repetition():
    at = law("waypoints", 2, times=[0.0, 1.0, 2.0], points=[0, 5, 1, 6, 0, 5], repeat=True)
    assert at(1.0)[0] == pytest.approx([1.0, 6.0])
    assert at(3.0)[0] == pytest.approx([1.0, 6.0])


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (("trajectory=waypoints", "times=[0.0, 2.0, 1.0]"), "times that ascend"),
        (("trajectory=waypoints", "points=[1.0, 2.0]"), "2 numbers given, 6 needed"),
        (("trajectory=recorded", "file=nowhere.csv"), r"nowhere\.csv does not exist"),
        (("trajectory=recorded",), "file is missing"),
    ],
)
def test_what_is_no_motion_is_refused(settings, message):
    with pytest.raises(BadInput, match=message):
        load("tora", settings=[f"trajectory_generator.{each}" for each in settings])


def written(path, header, rows):
    np.savetxt(path, rows, delimiter=",", header=header, comments="")
    return str(path)


def test_a_motion_from_a_table_by_its_columns(tmp_path):
    t = np.arange(0.0, 4.0, 0.05)
    rows = np.c_[t + 100.0, np.cos(t), np.sin(t)]
    path = written(tmp_path / "motion.csv", "time [s],q2,q3", rows)
    at = law("recorded", 2, file=path, controlled=["q3", "q2"])
    assert at(2.0)[0] == pytest.approx([math.sin(2.0), math.cos(2.0)], abs=1e-6)
    assert at(2.0)[2] == pytest.approx([-math.sin(2.0), -math.cos(2.0)], abs=1e-3)
    milliseconds = written(tmp_path / "ms.csv", "t [ms],a,b", np.c_[t * 1e3, rows[:, 1:]])
    at = law("recorded", file=milliseconds, controlled=["q3"], columns=["b"])
    assert at(2.0)[0][0] == pytest.approx(math.sin(2.0), abs=1e-6)


@pytest.mark.parametrize(
    ("rows", "values", "message"),
    [
        ([[0, 1, 2], [1, 2, 3]], {"columns": ["q9"]}, "no column 'q9'"),
        ([[0, 1, 2], [1, math.nan, 3], [2, 1, 1]], {}, "sample 2 of 'q2' is missing"),
        ([[0, 1, 2], [2, 1, 2], [1, 3, 3]], {}, "time of sample 3 is not behind"),
        ([[0, 1, 2], [1, 2, 3]], {"columns": ["q2", "q3"]}, "2 given, 1 needed"),
    ],
)
def test_a_table_that_is_no_motion(tmp_path, rows, values, message):
    path = written(tmp_path / "motion.csv", "t,q2,q3", np.array(rows, dtype=float))
    with pytest.raises(BadInput, match=message):
        law("recorded", file=path, controlled=["q2"], **values)


def test_a_motion_from_a_recording(tmp_path):
    """What one run did is what the next one is to do."""
    from fpt_ros.cli.app import run_command

    bag = tmp_path / "bag"
    assert run_command(["simulate", "duffing", "--duration", "1.0", "--record", str(bag)]) == 0
    from fpt_ros.bags.reader import read_run

    measured = read_run(bag).topics["joint_states"]
    at = law("recorded", file=str(bag), controlled=["q1"], every=50)
    assert at(0.5)[0][0] == pytest.approx(measured.column("position", "q1")[500], abs=1e-5)
