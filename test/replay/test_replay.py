"""One node, or all of them, again from a recording: the same bits, or where first not."""

import math
import random
from pathlib import Path

import pytest
import samples
from recorded_changes import INFO, recorded

from fpt_ros.bags.reader import info, read_run
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import Command, Frame
from fpt_ros.messages.topics import COMMAND, DESIRED, JOINT_STATES, Topic
from fpt_ros.replay.compared import Difference
from fpt_ros.replay.recorded import Recorded
from fpt_ros.replay.replayed import Replay
from fpt_ros.replay.rerun import rerun
from fpt_ros.replay.writing import ReplayWriter

CHANGES = {
    "tora": {
        0: {"fpt_deformer": {"A": -0.15}},
        40: {"fpt_deformer": {"A": -0.2, "approximate.m": 11.0}},
        41: {"trajectory_generator": {"lambda": 5.0}},
        60: {
            "plant_simulator": {"exact.m": 21.0},
            "trajectory_generator": {"amplitude": [0.2, 0.4]},
        },
    },
    "vdp_rfpt": {30: {"parameter_tuner": {"alpha": 2.0}, "fpt_deformer": {"A": 2e-6}}},
    "noisy_tora": {
        30: {"plant_simulator": {"noise.position": 2e-5}},
        50: {"fpt_deformer": {"A": -1.0}},
    },
    "cart_beam_hamper": {30: {"fpt_deformer": {"A": 2e-8}, "parameter_tuner": {"epsilon": 2.0}}},
    "swing": {},
    "tora_auto": {20: {"parameter_tuner": {"precursor_guard": True}}},
}
CYCLES = 120


@pytest.fixture(scope="module")
def tora(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return recorded(tmp_path_factory.mktemp("replay") / "tora", "tora", CYCLES, CHANGES["tora"])


@pytest.mark.parametrize("name", sorted(CHANGES))
def test_all_nodes_and_the_whole_run(tmp_path: Path, name: str) -> None:
    run = Recorded(recorded(tmp_path / "bag", name, CYCLES, CHANGES[name]))
    assert len(run.nodes) >= 4
    for node in run.nodes:
        found = Replay(run, node).run()
        assert (found.first, found.cycles, found.notes) == (None, CYCLES, ()), node
    (whole,) = rerun(run).values()
    assert (whole.first, whole.cycles, whole.notes) == (None, CYCLES, ())


def test_another_parameter_names_the_first_cycle(tora: Path) -> None:
    found = Replay(
        Recorded(tora).with_settings({"fpt_deformer": {"A": -0.1}}), "fpt_deformer"
    ).run()
    assert found.first is not None
    assert (found.first.topic, found.first.cycle) == ("/command", 1)  # cycle 0 has no response yet
    assert found.first.field.startswith("accelerations.")
    assert found.first.recorded != found.first.now
    assert 0 < found.differing < found.cycles == CYCLES
    heavier = Replay(
        Recorded(tora).with_settings({"plant_simulator": {"exact.m": 20.5}}), "plant_simulator"
    ).run()
    assert heavier.first is not None
    assert (heavier.first.topic, heavier.first.cycle) == ("/joint_states", 1)
    other = Replay(
        Recorded(tora).with_settings({"denoiser": {"method": "savgol"}}), "denoiser"
    ).run()
    assert not other.equal


def test_a_change_that_the_recording_does_not_tell(tmp_path: Path) -> None:
    """The whole run differs from the cycle on in which something else was in force."""
    bag = recorded(tmp_path / "bag", "tora", CYCLES, {50: {"fpt_deformer": {"A": -0.2}}})
    run = Recorded(bag)
    run.changes = ()
    (whole,) = rerun(run).values()
    assert whole.first is not None
    assert (whole.first.topic, whole.first.cycle) == ("/command", 50)


def test_a_damaged_number_is_found_by_its_node_alone(tmp_path: Path) -> None:
    def alter(topic: Topic, frame: Frame) -> Frame:
        if topic is DESIRED and frame.stamp == 70_000_000:
            assert hasattr(frame, "velocities")
            q3, q2 = frame.velocities
            return frame._replace(velocities=(math.nextafter(q3, 1.0), q2))  # type: ignore[call-arg]
        return frame

    run = Recorded(recorded(tmp_path / "bag", "tora", CYCLES, alter=alter))
    found = Replay(run, "trajectory_generator").run()
    assert found.first is not None
    assert (found.differing, found.first.cycle) == (1, 70)
    assert (found.first.topic, found.first.field) == ("/desired", "velocities.q3")
    assert Replay(run, "denoiser").run().equal
    (whole,) = rerun(run).values()
    assert whole.first == found.first


def test_the_recording_of_a_replay_is_a_recording(tora: Path, tmp_path: Path) -> None:
    stronger = Replay(Recorded(tora).with_settings({"fpt_deformer": {"A": -0.3}}), "fpt_deformer")
    with ReplayWriter(tmp_path / "out", stronger) as out:
        differs = stronger.run(out=out)
    assert not differs.equal
    again = Recorded(tmp_path / "out")
    assert again.parameters["fpt_deformer"]["A"] == -0.3
    assert info(tmp_path / "out")["complete"] is True
    for node in again.nodes:
        found = Replay(again, node).run()
        # the plant did not see the new commands
        assert found.equal == (node != "plant_simulator"), node
    one, other = read_run(tora), read_run(tmp_path / "out")
    for name, series in one.topics.items():
        same = all(
            matrix.tobytes() == other.topics[name].vectors[key].tobytes()
            for key, matrix in series.vectors.items()
        )
        assert same == (name != "command"), name


# --- recordings that are not whole


def test_cut_and_flipped_anywhere(tmp_path: Path) -> None:
    whole = recorded(tmp_path / "bag", "tora", 800)
    data, path, draw = (whole / "bag_0.mcap").read_bytes(), tmp_path / "bad.mcap", random.Random(14)
    some = 0
    for trial in samples.sample(range(100), 12):
        bad = bytearray(data)
        at = draw.randrange(len(data))
        bad[at] ^= 1 << draw.randrange(8)
        path.write_bytes(data[:at] if trial % 2 else bad)
        try:
            run = Recorded(path)
            found = [Replay(run, "fpt_deformer").run(), *rerun(run).values()]
        except BadInput:
            continue
        assert run.missing, at
        assert not run.complete, at
        for one in found:
            assert one.notes, at
            assert one.equal, at
        some += found[-1].cycles < 800
    assert some


def test_a_hole_ends_a_replay_but_not_a_rerun(tmp_path: Path) -> None:
    def alter(topic: Topic, frame: Frame) -> Frame | None:
        return None if 50 <= frame.stamp // 1_000_000 < 60 else frame

    run = Recorded(recorded(tmp_path / "bag", "tora", CYCLES, alter=alter))
    for node in run.nodes:
        found = Replay(run, node).run()
        assert (found.cycles, found.equal) == (50, True)
        assert found.notes == ("cycle 50 is not in the recording",)
    (whole,) = rerun(run).values()
    assert (whole.cycles, whole.equal) == (CYCLES - 10, True)


def test_an_answer_that_is_missing_in_a_whole_recording(tmp_path: Path) -> None:
    def alter(topic: Topic, frame: Frame) -> Frame | None:
        return None if topic is DESIRED and frame.stamp == 50_000_000 else frame

    run = Recorded(recorded(tmp_path / "bag", "tora", CYCLES, alter=alter))
    found = Replay(run, "trajectory_generator").run()
    assert found.first == Difference("/desired", "header.stamp", 50, None, 0.05)
    deformer = Replay(run, "fpt_deformer").run()
    assert (deformer.cycles, deformer.equal) == (50, True)
    assert deformer.notes == ("what fpt_deformer needs in cycle 50 is not there",)


def test_a_run_that_diverged_diverges_again(tmp_path: Path) -> None:
    from fpt_ros.bags.recording import EngineRecording
    from fpt_ros.engine.engine import Engine
    from fpt_ros.errors import Diverged
    from fpt_ros.experiments.experiment import load

    lost = load("tora", settings=["fpt_deformer.A=0.1"])
    with pytest.raises(Diverged), EngineRecording(tmp_path / "bag", lost) as recording:
        Engine(lost.loop(), consumers=(recording,)).run()
    run = Recorded(tmp_path / "bag")
    (whole,) = rerun(run).values()
    assert (whole.cycles, whole.equal) == (412, True)
    assert "the run now diverged at t = 0.411 s" in whole.notes[0]
    assert all(Replay(run, node).run().equal for node in run.nodes)


def test_the_second_part_of_a_split_recording_cannot_begin(tmp_path: Path) -> None:
    def alter(topic: Topic, frame: Frame) -> Frame | None:
        return frame if frame.stamp >= 50_000_000 else None

    run = Recorded(recorded(tmp_path / "bag", "tora", CYCLES, alter=alter))
    with pytest.raises(BadInput, match=r"begins at t = 0.05 s: .*of a split recording give the"):
        rerun(run)


def test_what_cannot_be_replayed(tora: Path, tmp_path: Path) -> None:
    run = Recorded(tora)
    with pytest.raises(BadInput, match="there is no node 'deformer' to replay: there are plant_s"):
        Replay(run, "deformer")
    with pytest.raises(BadInput, match="holds nothing of the node parameter_tuner: it has plant"):
        Replay(run, "parameter_tuner")
    with pytest.raises(BadInput, match=r"fpt_deformer has no parameter 'gain'"):
        Replay(run.with_settings({"fpt_deformer": {"gain": 1.0}}), "fpt_deformer")
    with pytest.raises(BadInput, match=r"fpt_deformer.K: 'high' is not valid, it takes a number"):
        Replay(run.with_settings({"fpt_deformer": {"K": "high"}}), "fpt_deformer")
    with pytest.raises(BadInput, match="does not exist"):
        Recorded(tmp_path / "nothing")


# --- real time


def test_in_real_time_what_a_node_had_seen_follows_from_its_answers(tmp_path: Path) -> None:
    """The command of cycle 40 came late: an older one acted, and the tuner had not seen it."""
    from fpt_ros.bags.writer import BagWriter
    from fpt_ros.experiments.experiment import load
    from fpt_ros.messages.cdr import Codec
    from fpt_ros.messages.topics import STATE_ESTIMATE, TUNING

    start, late = 1_700_000_000_000_000_000, 40
    experiment = load("vdp_rfpt").for_graph(realtime=True)
    loop = experiment.loop()
    info = {**INFO, "clock": "realtime"}
    before: Command | None = None
    with BagWriter(tmp_path / "bag", experiment.nodes, info) as bag:

        def write(topic: Topic, frame: Frame) -> None:
            bag.write(f"/{topic.name}", topic.type, frame.stamp, Codec(topic).encode(frame))

        for cycle in range(CYCLES):
            stamp = start + cycle * loop.plant.cycle_time
            measured = loop.plant.measure(stamp, cycle)
            write(JOINT_STATES, measured)
            if cycle == 80:
                loop.plant.advance(loop.plant.safe_command(stamp), stamp - start)
                continue  # nobody answered at all
            estimate = loop.denoiser.step(measured)
            write(STATE_ESTIMATE, estimate)
            desired = loop.trajectory.step(estimate)
            write(DESIRED, desired)
            if cycle == 81:
                before = None  # the command acted on last is that of cycle 79, and has come
            seen = None if cycle == late + 1 else before
            tuning = loop.tuner.step(estimate, *([desired] if loop.tuner.law.desired else []), seen)
            write(TUNING, tuning)
            command = loop.deformer.step(estimate, desired, tuning)
            write(COMMAND, command)
            acted = before if cycle == late else command
            assert acted is not None
            loop.plant.advance(acted, stamp - start)
            before = command
    run = Recorded(tmp_path / "bag")
    assert run.realtime
    found = rerun(run)
    assert sorted(found) == sorted(run.nodes)
    assert {name: one.first for name, one in found.items()} == dict.fromkeys(run.nodes)
    assert found["plant_simulator"].cycles == CYCLES
    assert found["parameter_tuner"].cycles == CYCLES - 1


def test_a_recorder_that_came_late_to_a_run_in_real_time(tmp_path: Path) -> None:
    def alter(topic: Topic, frame: Frame) -> Frame | None:
        return frame if frame.stamp >= 20_000_000 else None

    info = {**INFO, "clock": "realtime"}
    run = Recorded(recorded(tmp_path / "bag", "tora", 40, alter=alter, info=info))
    found = rerun(run)["trajectory_generator"]
    assert found.first is not None
    assert found.first.cycle == 0
    (note,) = found.notes
    assert note.startswith("trajectory_generator: the first answer differs already: the recording")


# --- comparing
