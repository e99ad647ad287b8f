"""Records on buffers: the same memory, whoever holds it."""

import mmap
from array import array
from typing import NamedTuple

import numpy as np
import pytest

from fpt_ros.cycle.records import Layout
from fpt_ros.cycle.run import Run
from fpt_ros.cycle.stages import Loop
from fpt_ros.experiments.experiment import load
from fpt_ros.laws import Matrix, MutableVector


class Memory(NamedTuple):
    count: MutableVector
    ring: Matrix
    none: MutableVector


LAYOUT = Layout(Memory, count=1, ring=(2, 3), none=0)


def test_a_record_lies_on_its_buffer_in_the_order_of_its_fields():
    assert LAYOUT.size == 7
    for buffer in (LAYOUT.new(), np.zeros(7), memoryview(array("d", bytes(56)))):
        memory = LAYOUT.on(buffer)
        memory.count[0] = 1.0
        memory.ring[1, 2] = 6.0
        assert list(buffer) == [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 6.0]
        assert len(memory.none) == 0


def test_a_matrix_without_rows():
    empty = Layout(Memory, count=1, ring=(0, 3), none=0)
    assert len(empty.on(empty.new()).ring) == 0
    assert empty.on(np.zeros(1)).ring.shape == (0, 3)


def test_a_buffer_of_another_length_and_fields_that_are_not_there_are_refused():
    with pytest.raises(ValueError, match="7 numbers needed, the buffer holds 6"):
        LAYOUT.on(array("d", bytes(48)))
    with pytest.raises(TypeError, match="Memory has the fields count, ring, none"):
        Layout(Memory, count=1, ring=(2, 3))


@pytest.mark.parametrize(
    ("name", "variant"),
    [("vdp_rfpt", "adaptive"), ("noisy_tora", "adaptive"), ("spherical_pendulum", "adaptive")],
)
def test_a_loop_goes_on_from_states_that_were_kept_in_a_mapped_file(tmp_path, name, variant):
    """Sizes follow from the parameters: a stage made anew takes its memory from the file."""
    loaded = load(name, variant, duration=load(name, variant).nodes["plant_simulator"]["dt"] * 60)
    whole = [frame for _, frame in Run(loaded.loop()).frames()]
    first, files = loaded.loop(), []
    before = [frame for _, frame in Run(first).frames(30)]
    for stage in first.stages():
        path = tmp_path / stage.name
        path.write_bytes(bytes(stage.state) or b"\0")
        files.append(path.open("r+b"))
    mapped = [mmap.mmap(file.fileno(), 0) for file in files]
    again = Loop(
        *[
            type(stage)(stage.values, memoryview(each).cast("d") if len(stage.state) else None)
            for stage, each in zip(first.stages(), mapped, strict=True)
        ]
    )
    run = Run(again, 30, command=before[-1])
    after = [frame for _, frame in run.frames()]
    assert repr(plain(before + after)) == repr(plain(whole))


def plain(frames):
    return [(frame.stamp, frame.names, [list(each) for each in frame[2:]]) for frame in frames]
