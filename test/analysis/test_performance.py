"""Numbers of control engineers, against closed forms of a plant of second order."""

import math

import numpy as np
import pytest

from fpt_ros.analysis.performance import Performance
from fpt_ros.runs.chunks import rows

DT = 1e-3
END = 30.0
PARAMETERS = {"plant_simulator": {"dt": DT}}


def run_of(error, effort=None, velocity=None, nominal=1.0):
    """Messages of one coordinate with an error over time."""
    from fpt_ros.runs.run import Series

    stamps = np.arange(len(error), dtype=np.int64) * 1_000_000
    zero = np.zeros(len(error))

    def series(**columns):
        return Series(stamps, ("q",), {k: np.asarray(v)[:, None] for k, v in columns.items()})

    wanted = np.full(len(error), nominal)
    return {
        "joint_states": series(
            position=wanted - error,
            velocity=zero if velocity is None else velocity,
            effort=zero if effort is None else effort,
        ),
        "desired": series(positions=wanted, velocities=zero),
    }


def numbers(topics, size=None):
    performance = Performance(PARAMETERS)
    length = len(topics["desired"].stamps)
    for first in range(0, length, size or length):
        performance.take({n: rows(s, first, first + (size or length)) for n, s in topics.items()})
    return performance.result()


@pytest.fixture(scope="module")
def time():
    return np.arange(round(END / DT)) * DT


def test_first_order_step_has_the_closed_forms_of_books(time):
    tau, step = 0.5, 2.0
    found = numbers(run_of(step * np.exp(-time / tau)))["q"]
    assert found["rise_time"] == pytest.approx(tau * math.log(9.0), abs=2 * DT)
    assert found["settling_time"] == pytest.approx(tau * math.log(50.0), abs=0.02 * tau)
    assert found["overshoot_percent"] == 0.0
    assert found["iae"] == pytest.approx(step * tau, rel=2e-3)
    assert found["ise"] == pytest.approx(step**2 * tau / 2, rel=3e-3)
    assert found["itae"] == pytest.approx(step * tau**2, rel=2e-3)


@pytest.mark.parametrize("damping", [0.2, 0.5, 0.7])
def test_second_order_step_overshoots_as_books_say(time, damping):
    root = math.sqrt(1.0 - damping**2)
    error = -np.exp(-damping * time) * (np.cos(root * time) + damping / root * np.sin(root * time))
    found = numbers(run_of(error))["q"]
    expected = 100.0 * math.exp(-math.pi * damping / root)
    assert found["overshoot_percent"] == pytest.approx(expected, rel=1e-4)
    outside = np.flatnonzero(np.abs(error) > 0.02 * np.abs(error).max())
    assert found["settling_time"] == pytest.approx(time[outside[-1]] + DT, abs=0.02)


def test_what_never_settles_has_no_settling_time(time):
    # a motion that repeats itself crosses zero at the end too
    found = numbers(run_of(np.sin(2 * np.pi * time)))["q"]
    assert found["settling_time"] is None
    assert found["rise_time"] is None
    assert found["overshoot_percent"] is None


def test_a_perfect_run_and_one_without_messages():
    found = numbers(run_of(np.zeros(100)))["q"]
    assert found["settling_time"] == found["iae"] == 0.0
    assert found["rise_time"] is None
    empty = Performance(PARAMETERS).result()
    assert empty == {}


def test_energy_is_the_work_of_the_effort(time):
    effort, velocity = 3.0 * np.cos(time), 2.0 * np.cos(time)
    found = numbers(run_of(np.ones(len(time)), effort, velocity))
    assert found["q"]["energy"] == pytest.approx(6.0 * (END / 2 + math.sin(2 * END) / 4), rel=1e-3)


def test_huge_errors_have_no_numbers_that_json_cannot_write(time):
    found = numbers(run_of(np.full(len(time), 1e200), nominal=0.0))["q"]
    assert found["ise"] is None
    assert found["iae"] == pytest.approx(1e200 * END)


def test_numbers_do_not_depend_on_the_chunks(make):
    run = make("tora", duration=10.0)
    whole, parts = (Performance(run.parameters) for _ in range(2))
    whole.take(run.topics)
    for first in range(0, 10_000, 777):
        parts.take({name: rows(s, first, first + 777) for name, s in run.topics.items()})
    assert whole.result() == parts.result()
