"""One graph as the watcher knows it: what it tells, and the parameters that it has."""

import math
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field
from time import monotonic
from typing import Any, NamedTuple

from fpt_ros.nodes.listening import Changed, Health, Piece
from fpt_ros.parameters import Value
from fpt_ros.runs.latency import CYCLES, MISSED
from fpt_ros.tuning import GAIN
from fpt_ros.watch.heard import Heard

PLANT, DEFORMER = "plant_simulator", "fpt_deformer"

QUIET = 2.5
"""Seconds without a word after which a graph is said to be silent."""

LATENCIES = ("latency median [ms]", "latency p99 [ms]", "latency max [ms]")
"""Keys of the plant's /diagnostics in real time, of each second."""

TOLD = 600
"""Seconds of latencies that are kept."""

State = tuple[frozenset[str], int]
"""Nodes that are there, and how many runs have been heard: what their parameters are good for."""


class Live(NamedTuple):
    """A parameter that can change in flight; ``kind``: of rcl_interfaces/ParameterType."""

    node: str
    name: str
    text: str
    valid: str
    kind: int
    low: float
    high: float

    @property
    def choices(self) -> list[str]:
        """Words, where only some are valid."""
        words = self.valid.partition("one of ")[2]
        return words.split(", ") if words else []


class Told(NamedTuple):
    """Latencies of one second [ms] and the misses so far; ``at``: seconds on our clock."""

    at: float
    latencies: tuple[float, float, float]
    misses: int


@dataclass
class Robot:
    """A graph in its namespace.

    Attributes:
        nodes, triggers: of its loop that are there now; services as ``NODE/SERVICE``.
        is_settled: no node has come or gone since the last look.
        heard: the last cycles.
        health: what each node said last, and when.
        latencies: in real time, second by second.
        live: parameters that can change in flight, of all nodes.
        values: of all parameters, by node.
        changed: those that have changed since all were asked for.
        gains: the parameter A of the deformer, NaN where it has none, from which stamp [ns] on.
        version: counts what has become known of the parameters.
    """

    namespace: str
    nodes: frozenset[str] = frozenset()
    triggers: frozenset[str] = frozenset()
    is_settled: bool = False
    heard: Heard = field(default_factory=Heard)
    health: dict[str, tuple[Health, float]] = field(default_factory=dict)
    latencies: deque[Told] = field(default_factory=lambda: deque(maxlen=TOLD))
    live: tuple[Live, ...] = ()
    values: dict[str, dict[str, Value]] = field(default_factory=dict)
    changed: dict[str, dict[str, Value]] = field(default_factory=dict)
    gains: list[tuple[int, float]] = field(default_factory=list)
    version: int = 0
    described: State | None = None
    moved_at: float = -math.inf

    def take(self, event: Piece | Health | Changed) -> None:
        """What it has told."""
        if isinstance(event, Piece):
            if self.heard.take(event.topic, event.messages):
                self.moved_at = monotonic()
        elif isinstance(event, Changed):
            self.know(event.node, event.values)
            if event.node == DEFORMER and GAIN in event.values:
                self.gains.append((event.stamp, _number(event.values[GAIN])))
        else:
            if _cycles(event) < _cycles(self.health.get(event.node, (event, 0.0))[0]):
                self.described = None  # it has begun anew, perhaps with other parameters
            self.health[event.node] = event, monotonic()
            if LATENCIES[0] in event.values:
                found = [float(event.values.get(key, "nan")) for key in LATENCIES]
                misses = int(event.values.get(MISSED, "0"))
                self.latencies.append(Told(monotonic(), (found[0], found[1], found[2]), misses))

    def know(self, node: str, values: Mapping[str, Value]) -> None:
        """These are the values of some parameters of a node."""
        self.changed.setdefault(node, {}).update(values)
        own = self.values.setdefault(node, {})
        if any(own.get(name) != value for name, value in values.items()):
            own.update(values)
            self.version += 1

    def will_be_described(self) -> None:
        """Its nodes are asked for all parameters: what changes meanwhile is newer than answers."""
        self.changed = {}

    def describe(
        self, state: State, found: Mapping[str, tuple[list[Any], dict[str, Value]]]
    ) -> None:
        """These were the parameters when they were asked for: by node descriptors and values."""
        self.live = tuple(x for node, (each, _) in found.items() for x in _live(node, each))
        self.values = {
            node: {**values, **self.changed.get(node, {})} for node, (_, values) in found.items()
        }
        self.described = state
        gain = _number(self.values.get(DEFORMER, {}).get(GAIN))
        self.gains = [(0, gain)]  # what it was before nobody has told
        self.version += 1

    def state(self) -> str:
        """In a few words."""
        now = monotonic()
        if not self.nodes:
            return "not running"
        if DEFORMER in self.health and self.health[DEFORMER][0].summary.startswith("stopped"):
            return "emergency stop: the safe effort is commanded"
        if PLANT in self.health and "paused" in self.health[PLANT][0].summary:
            return "paused"
        if now - self.moved_at > QUIET:
            return "no cycles are heard"
        return "running"


def _number(value: Value | None) -> float:
    return float(value) if isinstance(value, int | float) else math.nan


def _cycles(said: Health) -> int:
    count = said.values.get(CYCLES, "")
    return int(count) if count.isdigit() else 0


def _live(node: str, descriptors: list[Any]) -> list[Live]:
    """Those of a node's parameters that can change in flight, from what it says of them."""
    found = []
    for each in descriptors:
        if each.read_only:
            continue
        spans = [*each.floating_point_range, *each.integer_range]
        low, high = (spans[0].from_value, spans[0].to_value) if spans else (-math.inf, math.inf)
        text, valid = each.description, each.additional_constraints
        found.append(Live(node, each.name, text, valid, each.type, float(low), float(high)))
    return found
