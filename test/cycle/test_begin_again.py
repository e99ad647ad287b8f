"""A stage that begins again remembers nothing: the same run once more, bit by bit."""

import pytest
import samples

from fpt_ros.cycle.denoiser import Denoiser
from fpt_ros.cycle.parameter_tuner import ParameterTuner
from fpt_ros.cycle.run import Run
from fpt_ros.experiments.experiment import available, load

CYCLES = 40
ALL = [(name, variant) for name, variants in available().items() for variant in variants]
KEPT = (
    ("tora", "rough"),
    ("tora_auto", "adaptive"),
    ("noisy_tora", "adaptive"),
    ("noisy_tora", "fuzzy"),
    ("panda", "adaptive"),
)


def frames(loop, cycles=CYCLES):
    return [repr(frame) for _, frame in Run(loop).frames(cycles)]


@pytest.mark.parametrize(("name", "variant"), samples.sample(ALL, 6, keep=KEPT))
def test_all_stages_begin_again(name, variant):
    loop = load(name, variant).loop()
    first = frames(loop)
    for stage in loop.stages():
        stage.begin_again()
    assert frames(loop) == first


def test_stages_that_meet_their_joints_with_the_first_message():
    """As nodes that were started by hand: size and start follow from what they are shown."""
    loaded = load("tora_auto")
    shown = list(Run(loaded.loop()).frames(CYCLES))
    for kind in (Denoiser, ParameterTuner):
        values = {**loaded.nodes[kind.name], "joints": [], "cycle_time": 0.0, "controlled": []}
        known = {each.name for each in kind.parameters(values)}
        stage = kind({key: value for key, value in values.items() if key in known})
        first = answers(stage, shown)
        stage.begin_again()
        assert answers(stage, shown) == first


def answers(stage, shown):
    found, now, before = [], {}, {}
    for topic, frame in shown:
        now[topic.name] = frame
        if topic.name == "command":  # the last one of a cycle
            given = [(before if each.lag else now).get(each.topic.name) for each in stage.inputs]
            found.append(repr(stage.step(*given)))
            before, now = now, {}
    return found
