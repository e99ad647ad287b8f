"""A stage made of what was kept goes on with the same bits, in every cycle of every experiment."""

import random
from dataclasses import replace

import pytest
import samples

from fpt_ros.cycle.run import Run
from fpt_ros.errors import Diverged
from fpt_ros.experiments.experiment import available, load
from fpt_ros.messages.cdr import Codec
from fpt_ros.nodes.kept import Kept

CYCLES = 60

EVERYTHING = [(name, variant) for name, found in available().items() for variant in found]
KEEP = [("tora", "rough"), ("noisy_tora", "fuzzy"), ("tora_auto", "adaptive")]


def bytes_of(frames):
    return [Codec(topic).encode(frame) for topic, frame in frames]


def one_cycle(loop, cycle, command):
    """The frames of one cycle; the memories of the loop are those of its start."""
    return list(Run(loop, cycle, command).frames(1))


@pytest.mark.parametrize(("name", "variant"), samples.sample(EVERYTHING, 8, KEEP))
def test_each_stage_may_be_replaced_between_any_two_cycles(tmp_path, name, variant):
    loaded, chance = load(name, variant), random.Random(f"{name} {variant}")
    truth = Run(loaded.loop())
    frames, loop, command = truth.frames(CYCLES), loaded.loop(), None
    topics = 1 + sum(bool(stage.inputs) for stage in loop.answering())
    for cycle in range(min(CYCLES, loop.plant.cycles)):
        try:
            expected = bytes_of([next(frames) for _ in range(topics)])
        except Diverged:
            return
        found = one_cycle(loop, cycle, command)
        assert bytes_of(found) == expected, cycle
        command = found[-1][1]
        field = chance.choice([each for each in vars(loop) if takes_part(getattr(loop, each))])
        loop = replace(loop, **{field: in_its_place(getattr(loop, field), tmp_path / str(cycle))})


def takes_part(stage):
    return bool(stage.inputs)


def in_its_place(stage, folder):
    folder.mkdir()
    Kept(stage.name, print, folder).add(0, stage, 1, b"")
    (kept,) = Kept(stage.name, print, folder).cycles
    again = type(stage)(stage.values, kept.state)
    again.clock[0], again.clock[1] = kept.clock
    return again


def test_changes_that_were_in_force_later_are_pending_again(tmp_path):
    kept = Kept("fpt_deformer", print, tmp_path)
    for k in range(40):
        kept.accept({"A": -0.1 * k, "weights": [1.0, float(k)]})
        kept.put_into_force(k, {"A": -0.1 * k, "weights": [1.0, float(k)]})
    kept.accept({"A": -7.5})
    kept.aside["paused"] = True
    kept.save()
    again = Kept("fpt_deformer", print, tmp_path)
    assert again.aside == {"paused": True}
    assert again.rewind(39) == {"A": -0.1 * 38, "weights": [1.0, 38.0]}
    assert again.pending == {"A": -7.5, "weights": [1.0, 39.0]}
    assert [stamp for stamp, _ in again.told] == list(range(24, 39))
    whole = Kept("fpt_deformer", print, tmp_path)
    assert whole.rewind(100) == {"A": -0.1 * 39, "weights": [1.0, 39.0]}
    assert whole.pending == {"A": -7.5}


def test_where_there_is_no_space_the_node_goes_on_and_says_so(tmp_path, monkeypatch):
    import os

    def full(*arguments):
        raise OSError(28, os.strerror(28))

    monkeypatch.setattr(os, "posix_fallocate", full)
    said, stage = [], load("tora").loop().denoiser
    kept = Kept("denoiser", said.append, tmp_path)
    kept.add(0, stage, 1, b"")
    kept.add(1, stage, 2, b"")
    assert said == ["the state cannot be kept, a killed node ends the run: No space left on device"]
