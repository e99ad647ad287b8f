"""A run in outline: the same whatever the chunks, and what its figures show."""

import numpy as np
import pytest

from fpt_ros.analysis import motions, outline, signals
from fpt_ros.analysis.outline import DESIRED, REALISED, Outliner
from fpt_ros.analysis.thinner import CAPACITY, Window
from fpt_ros.runs.changes import Change
from fpt_ros.runs.chunks import rows
from fpt_ros.runs.run import Run, Series

CYCLES = 100_000


@pytest.fixture(scope="module")
def long():
    """A run of two coordinates, one of them controlled, with one cycle that stands out."""
    stamps = 1_000_000 * np.arange(CYCLES, dtype=np.int64)
    time = stamps / 1e9
    rng = np.random.default_rng(1)
    nominal = np.sin(2 * np.pi * time / 4.0)
    position = nominal + 1e-3 * rng.standard_normal(CYCLES)
    position[70_707] += 0.5

    def series(names, **columns):
        vectors = {key: np.column_stack(each) for key, each in columns.items()}
        return Series(stamps, names, vectors)

    zero = np.zeros(CYCLES)
    response = rng.standard_normal(CYCLES)
    topics = {
        "joint_states": series(("a", "b"), position=[position, time], velocity=[zero, zero]),
        "state_estimate": series(("a", "b"), accelerations=[response, zero]),
        "desired": series(("a",), positions=[nominal], velocities=[zero], accelerations=[-nominal]),
        "command": series(
            ("a", "b"), accelerations=[response, np.full(CYCLES, np.nan)], effort=[zero, time]
        ),
    }
    parameters = {"recorder": {"settle_time": 50.0}, "plant_simulator": {"dt": 0.001}}
    return Run({"complete": "true"}, parameters, topics)


def in_chunks(run, size):
    outliner = Outliner(run.parameters)
    for first in range(0, CYCLES, size):
        outliner.take({name: rows(s, first, first + size) for name, s in run.topics.items()})
    return outliner.result(run)


def test_an_outline_keeps_peaks_and_exact_numbers(long):
    found = in_chunks(long, 8192)
    motion, whole = found.motions["a"], motions.motion(long, "a")
    assert len(motion.time) <= CAPACITY + 2
    assert np.abs(motion.error).max() == np.abs(whole.error).max() > 0.4
    late = whole.error[50_000:]
    assert found.settled_rms["a"] == pytest.approx(np.sqrt(np.mean(late**2)), rel=1e-12)
    assert found.end == pytest.approx(99.999)
    assert signals.uncontrolled(found) == ("b",)


def test_the_excerpt_has_every_point_of_a_long_run(long):
    found = in_chunks(long, 8192)
    assert found.period == pytest.approx(4.0, rel=1e-2)
    curve = found.curve(DESIRED, "a", Window(49.0, 51.0))
    assert len(curve.time) == 2001
    realised = found.curve(REALISED, "a", Window(49.0, 51.0))
    expected = long.topics["state_estimate"].column("accelerations", "a")[49_001:51_002]
    assert np.array_equal(realised.values, expected)
    far = found.curve(DESIRED, "a", Window(5.0, 6.0))  # thinned there
    assert 100 < len(far.time) < 1000


def test_an_outline_does_not_depend_on_the_chunks(long):
    whole, found = outline.outline(long), in_chunks(long, 7001)
    for key, curve in whole.curves.items():
        assert np.array_equal(curve.values, found.curves[key].values, equal_nan=True)
        assert np.array_equal(curve.time, found.curves[key].time)
    assert np.array_equal(whole.motions["a"].error, found.motions["a"].error)
    assert (whole.period, whole.end) == (found.period, found.end)
    assert outline.outline(found) is found


def test_changes_in_flight_count_from_the_first_stamp():
    stamps = 5_000_000_000 + 1_000_000 * np.arange(2000, dtype=np.int64)
    measured = Series(stamps, ("a",), {"position": np.zeros((2000, 1))})
    change = Change("fpt_deformer", 6_000_000_000, {"A": -2.0})
    found = outline.outline(Run({}, {}, {"joint_states": measured}, None, (change,)))
    assert [each.stamp for each in found.changes] == [1_000_000_000]
    assert outline.outline(found) is found
