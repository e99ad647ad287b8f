"""What all stages of the loop share.

A stage is one box of the loop: parameters, a small numeric state, and a step from the frames of its
cycle to the frame that it publishes. It knows no ROS and no clock but the stamps of its frames, so
the in-process engine, a node and a replay run the same object and get the same bits.
"""

from abc import ABC, abstractmethod
from array import array
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

from fpt_ros.cycle.content import check_content
from fpt_ros.cycle.joints import Entrance
from fpt_ros.cycle.records import Buffer, Layout
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND, Frame, Names
from fpt_ros.messages.topics import DESIRED, Topic
from fpt_ros.parameters import Parameter, Values, resolve

REALTIME = Parameter("realtime", "on the wall clock instead of in lockstep", False, live=False)
"""Declared by all nodes: what they wait for depends on it."""

ROBOT = Parameter(
    "robot",
    "joint_states come from a robot: of any quality of service, with stamps of any clock or none",
    False,
    live=False,
)
"""Declared by all that listen to ``joint_states``; in real time alone."""

CYCLE_TIME = Parameter(
    "cycle_time",
    "nominal length of a cycle, the plant's dt; 0: not known, it is the first gap between messages",
    0.0,
    unit="s",
    minimum=0.0,
    live=False,
)
"""Of the stages that answer; derived from the plant's ``dt`` where an experiment is loaded."""

AUTOSTART = Parameter(
    "autostart",
    "the node configures and activates itself; else it waits for ros2 lifecycle set",
    True,
    live=False,
)
"""Declared by the nodes of the loop."""

ENDS_WITH_PLANT = Parameter(
    "ends_with_plant",
    "the node ends when the plant's node says that the run is over; for those of other hosts",
    False,
    live=False,
)
"""Declared by all nodes but the plant's."""

ANSWERING = (CYCLE_TIME, AUTOSTART, ENDS_WITH_PLANT)
"""Of the stages that answer the plant."""

IN_FLIGHT = "cannot change while the loop runs"
"""What a refusal of such a change says."""

JOINTS = Parameter(
    "joints",
    "names of the plant's coordinates, in its order; empty: as the first message has them",
    [],
    kind="strings",
    live=False,
)
"""Derived from the plant where an experiment is loaded."""


Memory = TypeVar("Memory", bound=tuple[Any, ...])


@dataclass(frozen=True)
class Input:
    """A topic that a stage needs in every cycle.

    ``lag`` 0: the message of the same cycle; 1: that of the cycle before, of which there is none in
    the first cycle. ``optional``: in real time it is not waited for.
    """

    topic: Topic
    lag: int = 0
    optional: bool = False


class Stage(ABC):
    """Base of the five stages.

    Attributes:
        name: of the node that runs it, and of its section in a parameter file.
        output: the topic that it publishes.
        values: all parameters, complete and checked.
        state: what it remembers, as doubles. Its size follows from the parameters; where these do
            not name the joints, from the first frame. It is never assigned anew: ``memory`` is made
            of views into it.
        layout: of the memory on the state; ``None``: its size is not known yet.
        entrances: by the name of an input topic, which joints it has to hold.
        clock: stamps [ns] of the first and of the latest cycle seen, -1 before.
    """

    name: ClassVar[str]
    output: ClassVar[Topic]

    def __init__(self, given: Values, state: Buffer | None = None) -> None:
        """Configure from parameters by name.

        Args:
            given: parameters; those with a default may be missing.
            state: a buffer of doubles to remember on, as it was left (an array, mapped memory);
                by default a new one.

        Raises:
            BadInput: an unknown, missing or invalid parameter.
        """
        self.values = resolve(self.parameters(given), given, self.name)
        self.state: Buffer = array("d") if state is None else state
        self.layout: Layout[Any] | None = None
        self.entrances: dict[str, Entrance] = {}
        self.clock = array("q", (-1, -1))
        self._prepare()

    @classmethod
    @abstractmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Parameters of the stage; which ones depends on the laws that ``given`` names.

        Raises:
            BadInput: ``given`` names a law that is not registered.
        """

    @property
    def heals(self) -> bool:
        """Whether it goes on where samples are lost."""
        return False

    @property
    def inputs(self) -> tuple[Input, ...]:
        """Topics that each step needs, in the order of the step's arguments."""
        return ()

    def admit(self, topic: Topic, frame: Frame) -> Frame:
        """The frame of an input as the stage wants it: its joints, in its order, usable numbers.

        Raises:
            BadInput: a joint is absent, the frame is not whole, or a number is not usable.
        """
        who, entrance = f"{self.name}, {topic.name}", self.entrances.get(topic.name)
        if topic is DESIRED:  # behind the entrance NaN is a joint whose turn it is not
            check_content(who, topic, frame)
        if entrance is not None:
            frame = entrance.take(frame)
        if topic is not DESIRED:
            check_content(who, topic, frame, self.heals)
        return frame

    def report(self) -> dict[str, object]:
        """What a watcher should know of its state now, by name; told on /diagnostics."""
        return {}

    def configure(self, changes: Values) -> None:
        """Change live parameters; what was remembered stays.

        Raises:
            BadInput: one is unknown, not live or not valid; nothing is changed then.
        """
        before, declared = self.values, self.parameters(self.values)
        values = resolve(declared, {**before, **changes}, self.name)
        for parameter in declared:
            if not parameter.live and values[parameter.name] != before[parameter.name]:
                live = ", ".join(sorted(each.name for each in declared if each.live)) or "none"
                raise BadInput(f"{self.name}.{parameter.name} {IN_FLIGHT}, only {live}")
        self.values = values
        try:
            self._prepare()
        except Exception:
            self.values = before
            self._prepare()
            raise

    def begin_again(self) -> None:
        """Forget all that was remembered: the next cycle is the first one. Parameters stay."""
        start = self._at_start()
        self._prepare()  # without what a tuner has put into force
        self.clock[0] = self.clock[1] = -1
        known = len(start.state) > 0  # else the first frame tells the size
        for i in range(len(self.state)):
            self.state[i] = start.state[i] if known else 0.0

    def _at_start(self) -> "Stage":
        """A new stage with the same parameters."""
        return type(self)(self.values)

    @abstractmethod
    def _prepare(self) -> None:
        """Work out the constants of the laws from ``values``."""

    def _remember(self, layout: Layout[Memory]) -> tuple[Memory, bool]:
        """The memory of this layout on the state, and whether it is new, all zeros.

        Raises:
            BadInput: a change in flight asks for a memory of another size.
        """
        fresh = not len(self.state)
        if self.layout is not None and layout.size != len(self.state):
            raise BadInput(
                f"{self.name}: with these parameters it would remember {layout.size} numbers "
                f"instead of {len(self.state)}: that {IN_FLIGHT}"
            )
        self.layout = layout
        if fresh and isinstance(self.state, array):
            self.state.frombytes(bytes(8 * layout.size))
        return layout.on(self.state), fresh

    def _advance_clock(self, stamp: int) -> tuple[float, float]:
        """Time since the first cycle and since the latest one [s]; 0.0 and 0.0 in the first."""
        first, latest = self.clock
        if first < 0:
            self.clock[0] = self.clock[1] = stamp
            return 0.0, 0.0
        self.clock[1] = stamp
        return (stamp - first) / SECOND, (stamp - latest) / SECOND


def indices(wanted: Sequence[str], names: Names, who: str) -> tuple[int, ...]:
    """Where each wanted coordinate stands among ``names``.

    Raises:
        BadInput: one is not there; ``who`` names the parameter that asks for it.
    """
    for name in wanted:
        if name not in names:
            raise BadInput(f"{who}: there is no coordinate '{name}', only {', '.join(names)}")
    return tuple(names.index(name) for name in wanted)
