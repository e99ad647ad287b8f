"""Which constants of a loop are switches, and how they come into its code."""

from typing import NamedTuple

from fpt_ros.cycle.loop import CycleConstants
from fpt_ros.engine.switches import read, written
from fpt_ros.engine.types import empty
from fpt_ros.laws import Switch, Vector


class Inner(NamedTuple):
    factor: float
    order: Switch


class Outer(NamedTuple):
    number: int
    on: Switch
    inner: Inner
    vector: Vector


def test_switches_are_found_by_place_and_written_as_numbers():
    record = Outer(5, True, Inner(0.5, 2), [1.0])
    switches = read("outer", record)
    assert switches == (("outer.on", 1), ("outer.inner.order", 2))
    text, classes = written({"first": int, "outer": Outer}, switches)
    assert text == "first, Outer(outer.number, 1, Inner(outer.inner.factor, 2), outer.vector)"
    made = eval(text, classes | {"first": 0, "outer": Outer(7, False, Inner(0.25, 1), [])})
    assert made == (0, Outer(7, 1, Inner(0.25, 2), []))


def test_numbers_that_a_sweep_may_vary_are_no_switches():
    places = dict(read("constants", empty(CycleConstants)))
    assert "constants.deformer.limits.stopped" in places
    for number in ("plant.substeps", "plant.late", "deformer.delay", "cycle_time"):
        assert f"constants.{number}" not in places
