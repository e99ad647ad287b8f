"""A small recording of known numbers, and what happens to recordings."""

import contextlib
from pathlib import Path

from fpt_ros.bags.bag import Bag
from fpt_ros.bags.split import Split
from fpt_ros.bags.writer import NEVER, BagWriter
from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import Command, JointStates
from fpt_ros.messages.topics import COMMAND, JOINT_STATES

PARAMETERS = {"plant_simulator": {"plant": "tora", "seed": 7}, "fpt_deformer": {"A": -0.1}}
INFO = {"experiment": "tora", "variant": "adaptive", "engine": "graph", "clock": "lockstep"}
STEP = 1_000_000


def fill(bag: BagWriter, cycles: int, first: int = 0) -> None:
    """Two topics; position, velocity and effort of cycle k say k."""
    states, commands = Codec(JOINT_STATES), Codec(COMMAND)
    for k in range(first, first + cycles):
        x = float(k)
        frame = JointStates(k * STEP, ("q1", "q2"), (x, -x), (2 * x, 0.5), (0.0, 1.0))
        bag.write("/joint_states", JOINT_STATES.type, k * STEP, states.encode(frame))
        command = Command(k * STEP, ("q1", "q2"), (x, 1.0), (3 * x, 2.0))
        bag.write("/command", COMMAND.type, k * STEP, commands.encode(command))


def recording(
    directory: Path, cycles: int = 400, chunks: int = 4, split: Split = NEVER, first: int = 0
) -> Path:
    """A whole recording; gives its first file."""
    with BagWriter(directory, PARAMETERS, INFO, split) as bag:
        path = bag.path
        bag.add_topic("/joint_states", JOINT_STATES.type)
        bag.add_topic("/command", COMMAND.type)
        bag.flush()  # the clock of flushing begins here
        for chunk in range(chunks):
            fill(bag, cycles // chunks, first + chunk * (cycles // chunks))
            bag.flush()
    return path


def positions(path: Path) -> tuple[list[float], Bag]:
    """The position of q1 in all messages that can be read, in the order of the file."""
    bag = Bag(path)
    codec = Codec(JOINT_STATES)
    found = []
    for item in bag.messages():
        if item.source.topic == "/joint_states":
            with contextlib.suppress(MalformedMessage):
                found.append(codec.decode(item.data)[2][0])
    return found, bag


def states(k: int) -> bytes:
    """Message number k on /joint_states."""
    frame = JointStates(k * STEP, ("q1",), (float(k),), (0.0,), (0.0,))
    return Codec(JOINT_STATES).encode(frame)
