"""Foreign publishers on the loop's topics: named once, ignored, and the numbers stay the same."""

import signal

import numpy as np
import samples
from command import OSCILLATOR, forked_fpt_json, fpt, start_fpt
from mcap_ros2.reader import read_ros2_messages
from stranger import frame, kinds, stranger
from watcher import watcher

from fpt_ros.bags.reader import read_run
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.topics import COMMAND, DESIRED, JOINT_STATES, LOOP_TOPICS, STATE_ESTIMATE

HEARD = {JOINT_STATES: 2, STATE_ESTIMATE: 3, DESIRED: 2, COMMAND: 2}
"""How many listen: those who use it, and the recorder. TORA has no tuner."""

FLOOD = 4000 if samples.whole else 1000


def begun(tmp_path, *options):
    process = start_fpt("run", "tora", "--duration", 1000, "--record", tmp_path / "bag", *options)
    with watcher() as graph:
        graph.wait_for_stamp(0.1)
    return process


def ended_unharmed(process, tmp_path):
    """The run has the numbers of the engine; what its nodes said."""
    process.send_signal(signal.SIGINT)
    _, stderr = process.communicate(timeout=60)
    assert process.returncode == 130, stderr
    run = read_run(tmp_path / "bag").topics["command"]
    cycles = len(run.stamps)
    engine = tmp_path / "engine"
    forked_fpt_json("simulate", "tora", "--duration", cycles / 1000, "--record", engine)
    truth = read_run(engine).topics["command"]
    assert np.array_equal(run.vectors["effort"], truth.vectors["effort"])
    return [
        message.ros_msg.msg
        for message in read_ros2_messages(tmp_path / "bag" / "bag_0.mcap", topics=["/rosout"])
    ]


def test_a_stranger_says_all_kinds_of_things_on_all_topics(tmp_path):
    process = begun(tmp_path)
    with stranger() as somebody:
        somebody.match(HEARD)
        for topic in LOOP_TOPICS:
            for stamp in (200_000_000, 10**9):
                for data in kinds(topic, stamp).values():
                    somebody.say(topic, data)
    with watcher() as graph:
        graph.wait_for_next()
    said = ended_unharmed(process, tmp_path)
    for topic in HEARD:
        named = f"on /{topic.name}, which has a publisher already"
        assert any(line.startswith("ignored: messages of") and named in line for line in said)


def test_a_flood(tmp_path):
    process = begun(tmp_path)
    with stranger(HEARD) as somebody, watcher() as graph:
        somebody.match(HEARD)
        data = {topic: Codec(topic).encode(frame(topic, 10**9)) for topic in HEARD}
        for _ in range(FLOOD):
            for topic in HEARD:
                somebody.say(topic, data[topic])
        graph.wait_for_stamp(1.5)
    ended_unharmed(process, tmp_path)


def test_a_second_graph_in_real_time_does_no_harm(tmp_path):
    process = start_fpt(
        "run", *OSCILLATOR, "--realtime", "--duration", 1000, "--record", tmp_path / "bag",
        "--set", "plant_simulator.dt=0.005",
    )  # fmt: skip
    with watcher() as graph:
        graph.wait_for_next()
    second = fpt("run", *OSCILLATOR, "--realtime")
    assert second.returncode == 1
    assert "ROS_DOMAIN_ID" in second.stderr
    with watcher() as graph:
        graph.wait_for_next()
    process.send_signal(signal.SIGINT)
    _, stderr = process.communicate(timeout=60)
    assert process.returncode == 130, stderr
    stamps = read_run(tmp_path / "bag").topics["joint_states"].stamps
    assert set(np.diff(stamps)) == {5_000_000}
