"""What all stages of the loop share.

A stage is one box of the loop: parameters, a small numeric state, and a step from the frames of its
cycle to the frame that it publishes. It knows no ROS and no clock but the stamps of its frames, so
the in-process engine, a node and a replay run the same object and get the same bits.
"""

from abc import ABC, abstractmethod
from array import array
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, part
from fpt_ros.messages.frames import SECOND, Names
from fpt_ros.messages.topics import Topic
from fpt_ros.parameters import Parameter, Values, resolve

REALTIME = Parameter("realtime", "on the wall clock instead of in lockstep", False, live=False)
"""Declared by all nodes: what they wait for depends on it."""

CYCLE_TIME = Parameter(
    "cycle_time",
    "length of a cycle in lockstep, by which messages of another run are known; 0: not known",
    0.0,
    unit="s",
    minimum=0.0,
    live=False,
)
"""Declared by the stages that answer; set by what starts the graph, from the plant's ``dt``."""


_Divided = tuple["array[float]", tuple[int, ...], tuple[MutableVector, ...]]
"""A state, where it is cut, and its parts."""


@dataclass(frozen=True)
class Input:
    """A topic that a stage needs in every cycle.

    ``lag`` 0: the message of the same cycle; 1: that of the cycle before, of which there is none in
    the first cycle.
    """

    topic: Topic
    lag: int = 0


class Stage(ABC):
    """Base of the five stages.

    Attributes:
        name: of the node that runs it, and of its section in a parameter file.
        output: the topic that it publishes.
        values: all parameters, complete and checked.
        state: what it remembers, as doubles; sized by the first frame.
        clock: stamps [ns] of the first and of the latest cycle seen, -1 before.
    """

    name: ClassVar[str]
    output: ClassVar[Topic]

    def __init__(self, given: Values) -> None:
        """Configure from parameters by name.

        Raises:
            BadInput: an unknown, missing or invalid parameter.
        """
        self.values = resolve(self.parameters(given), given, self.name)
        self.state = array("d")
        self.clock = array("q", (-1, -1))
        self._divided: _Divided = (self.state, (), ())
        self._prepare()

    @classmethod
    @abstractmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Parameters of the stage; which ones depends on the laws that ``given`` names.

        Raises:
            BadInput: ``given`` names a law that is not registered.
        """

    @property
    def inputs(self) -> tuple[Input, ...]:
        """Topics that each step needs, in the order of the step's arguments."""
        return ()

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
                raise BadInput(
                    f"{self.name}.{parameter.name} cannot change while the loop runs, only {live}"
                )
        self.values = values
        try:
            self._prepare()
        except BadInput:
            self.values = before
            self._prepare()
            raise

    @abstractmethod
    def _prepare(self) -> None:
        """Work out the constants of the laws from ``values``."""

    def _divide(self, *cuts: int) -> tuple[MutableVector, ...]:
        """The state cut at these places, each part to be read and written where it stands.

        Made anew only where the state is another, or cut otherwise: a state of which there are
        parts cannot change its size.
        """
        state, at, parts = self._divided
        if state is not self.state or at != cuts:
            parts = tuple(part(self.state, a, b) for a, b in pairwise((0, *cuts, len(self.state))))
            self._divided = self.state, cuts, parts
        return parts

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
