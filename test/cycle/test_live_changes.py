"""Parameters that change in flight: what is kept, refused, put into force."""

from typing import NamedTuple

import pytest
from stages_made import NAN, desired, estimate, frames_of, stages

from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.cycle.records import Layout
from fpt_ros.cycle.stage import Stage
from fpt_ros.errors import BadInput
from fpt_ros.experiments import experiment
from fpt_ros.laws import MutableVector
from fpt_ros.parameters import Parameter


def test_a_live_change_keeps_what_was_remembered():
    loop = stages("tora", duration=0.02)
    frames_of(loop)
    for stage, change in (
        (loop.deformer, {"A": -0.2, "approximate.m": 11}),
        (loop.trajectory, {"lambda": 5.0}),
        (loop.plant, {"exact.m": 21.0, "noise.position": 1e-3}),
    ):
        state, clock = list(stage.state), list(stage.clock)
        assert any(state)
        stage.configure(change)
        assert list(stage.state) == pytest.approx(state, abs=0.0, nan_ok=True)
        assert list(stage.clock) == clock
        for name, value in change.items():
            assert stage.values[name] == value


def test_a_live_change_takes_effect():
    def next_r(change):
        deformer = stages().deformer
        deformer.step(estimate(0, [NAN] * 3), desired(0, ("q3", "q2"), [0.0, 0.0]))
        deformer.configure(change)
        out = deformer.step(estimate(1, [0.0, 1.0, 1.0]), desired(1, ("q3", "q2"), [0.0, 0.0]))
        return out.accelerations[2], out.effort[0]

    as_it_was, doubled = next_r({}), next_r({"A": -0.2})
    assert doubled[0] == pytest.approx(2.0 * as_it_was[0], rel=0.2)
    heavier = next_r({"approximate.m": 20.0})
    assert heavier[0] == as_it_was[0]
    assert heavier[1] != as_it_was[1]


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"A": "fast"}, "fpt_deformer.A: 'fast' is not valid, it takes a number"),
        ({"gain": 1.0}, "fpt_deformer has no parameter 'gain'"),
        ({"A": -0.2, "K": 1.9}, "K = 1.9 and D = 0.6 give no fixed point"),
        ({"approximate.m": 20.0, "K": 1.9}, "K = 1.9 and D = 0.6 give no fixed point"),
        ({"approximate.m": 0.0}, "fpt_deformer.approximate.m: 0.0 is not valid"),
        ({"transformation": "none"}, "fpt_deformer.transformation cannot change while the loop"),
        ({"A": -0.2, "form": "signed"}, "fpt_deformer.form cannot change while the loop runs"),
    ],
)
def test_a_bad_live_change_is_refused_and_nothing_is_changed(change, reason):
    changed, untouched = stages().deformer, stages().deformer
    for deformer in (changed, untouched):
        deformer.step(estimate(0, [NAN] * 3), desired(0, ("q3", "q2"), [0.0, 0.0]))
    before = dict(changed.values)
    with pytest.raises(BadInput) as caught:
        changed.configure(change)
    assert reason in str(caught.value)
    assert "\n" not in str(caught.value)
    assert changed.values == before
    frames = estimate(1, [0.0, 1.0, 1.0]), desired(1, ("q3", "q2"), [0.0, 0.0])
    assert repr(changed.step(*frames)) == repr(untouched.step(*frames))


def test_what_may_not_change_in_flight_is_refused_with_what_may():
    with pytest.raises(BadInput) as caught:
        stages().plant.configure({"dt": 0.002})
    message = str(caught.value)
    assert message.startswith("plant_simulator.dt cannot change while the loop runs, only ")
    assert "exact.m" in message
    assert "seed" not in message
    stages().plant.configure({"dt": 0.001})  # the value that it has
    with pytest.raises(BadInput, match=r"cannot change while the loop runs, only healing.limit$"):
        stages().denoiser.configure({"method": "wavelet"})


@pytest.mark.parametrize("plant", ["tora", "duffing"])
def test_other_filters_are_refused_in_flight(plant):
    # of one coordinate, two members of the ladder remember as much as the four given filters
    given = {"method": "kalman_bank", "members": 2}
    loop = experiment.load(plant).with_values("denoiser", **given).loop()
    denoiser = loop.denoiser
    denoiser.begin(loop.plant.measure(0, 0))
    before, state = dict(denoiser.values), list(denoiser.state)
    with pytest.raises(BadInput, match="denoiser: other filters cannot change while the loop runs"):
        denoiser.configure({"sigma": 1e-3})
    with pytest.raises(BadInput, match="fastest"):
        denoiser.configure({"fastest": 1000.0})
    assert denoiser.values == before
    assert list(denoiser.state) == state
    denoiser.configure({"gate": 6.0})


class Numbers(NamedTuple):
    kept: MutableVector


class Growing(Stage):
    name = "growing"

    @classmethod
    def parameters(cls, given):
        return (Parameter("size", "how much it remembers", 3),)

    def _prepare(self):
        self.memory, _ = self._remember(Layout(Numbers, kept=self.values["size"]))


def test_a_memory_of_another_size_is_refused_in_flight():
    stage = Growing({})
    stage.memory.kept[2] = 7.0
    with pytest.raises(BadInput, match=r"growing: .* remember 4 numbers instead of 3: that cannot"):
        stage.configure({"size": 4})
    assert stage.values["size"] == 3
    assert list(stage.memory.kept) == [0.0, 0.0, 7.0]


def test_more_filters_are_refused_in_flight():
    denoiser = experiment.load("noisy_tora").loop().denoiser
    with pytest.raises(BadInput, match="states cannot change while the loop runs"):
        denoiser.configure({"states": [3.0, 4.0], "densities": [1e2, 1e4]})


def test_a_bad_live_list_is_refused():
    trajectory = stages().trajectory
    with pytest.raises(BadInput, match=r"amplitude: 1 given, 2 needed \(q3, q2\)"):
        trajectory.configure({"amplitude": [1.0]})
    assert trajectory.values["amplitude"] == [0.3, 0.5]
    out = trajectory.step(estimate(0, [NAN] * 3))
    assert len(out.positions) == 2


def test_a_stage_can_be_made_from_its_parameters_alone():
    loaded = experiment.load("tora")
    values = loaded.nodes["fpt_deformer"]
    assert FptDeformer(values).values == values
    with pytest.raises(BadInput, match=r"^fpt_deformer\.model is missing: it takes a word$"):
        FptDeformer({})
