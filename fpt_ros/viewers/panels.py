"""What to plot of a run, whatever program plots it: a page a joint, with units."""

from collections.abc import Iterator
from typing import NamedTuple

from fpt_ros.bags.flat import ACCELERATIONS, FLAT
from fpt_ros.bags.units import plant_of
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import Names
from fpt_ros.messages.topics import (
    COMMAND,
    DESIRED,
    JOINT_STATES,
    JOINT_TRAJECTORY,
    STATE_ESTIMATE,
    TUNING,
    Topic,
)
from fpt_ros.plants import Plant
from fpt_ros.runs.run import Run

_PER = {0: "", 1: "/s", 2: "/s^2"}
"""What makes the unit of the response of that of a position, by the order of the plant."""


class Curve(NamedTuple):
    """One number of a topic over time.

    Attributes:
        label: with the unit.
        topic: absolute.
        field: of the message, as in ``points[0].positions``.
        element: its place in that field.
        flat: topic and field of the flat view (:mod:`fpt_ros.bags.flat`).
        name: of the joint, or of what is tuned.
    """

    label: str
    topic: str
    field: str
    element: int
    flat: tuple[str, str]
    name: str


class Panel(NamedTuple):
    """Curves on one scale; ``title`` has the unit."""

    title: str
    curves: tuple[Curve, ...]


class Page(NamedTuple):
    """Panels below each other, on one axis of time."""

    title: str
    panels: tuple[Panel, ...]


def pages(run: Run) -> list[Page]:
    """A page a controlled joint, and one of what is tuned.

    Raises:
        BadInput: the names of a topic change in the run, as in time sharing: elements then have no
            fixed place.
    """
    plant = plant_of(run.parameters)
    if plant is None:
        raise BadInput("the recording names no plant that is known here: its units are not known")
    if run.parameters["trajectory_generator"].get("time_sharing"):
        raise BadInput(
            "the coordinates take turns (time_sharing): what stands where in a message changes, "
            "and no layout can name it"
        )
    namespace = run.info.get("namespace", "").strip("/")
    curves = _Curves(run, f"/{namespace}" if namespace else "")
    found = [Page(name, tuple(_of_joint(name, plant, curves))) for name in _controlled(run, plant)]
    tuned = tuple(
        Panel(name, (curves(TUNING, "values", name, ""),)) for name in curves.names(TUNING)
    )
    return [*found, *([Page("tuning", tuned)] if tuned else [])]


def _controlled(run: Run, plant: Plant) -> Names:
    """In the order of the plant."""
    names = run.topics[DESIRED.name].names if DESIRED.name in run.topics else ()
    return tuple(name for name in plant.coordinates if name in names)


class _Curves:
    """Makes the curves of a run."""

    def __init__(self, run: Run, namespace: str) -> None:
        self._run, self._namespace = run, namespace

    def names(self, topic: Topic) -> Names:
        """Of the topic's elements; none: it is not recorded."""
        return self._run.topics[topic.name].names if topic.name in self._run.topics else ()

    def __call__(self, topic: Topic, vector: str, name: str, label: str) -> Curve:
        field = topic.fields[topic.vectors.index(vector)]
        path = f"{self._namespace}/{topic.name}"
        element = self.names(topic).index(name)
        if topic.type != JOINT_TRAJECTORY:
            return Curve(label or name, path, field, element, (path, field), name)
        if field == "accelerations":
            flat = f"{path}/{ACCELERATIONS}", "position"
        else:
            singular = {"positions": "position", "velocities": "velocity"}.get(field, field)
            flat = f"{path}/{FLAT}", singular
        return Curve(label, path, f"points[0].{field}", element, flat, name)


def _of_joint(name: str, plant: Plant, curves: _Curves) -> Iterator[Panel]:
    at = plant.coordinates.index(name)
    unit, effort = plant.units[at], plant.effort_units[at]
    per = _PER.get(plant.order, "")
    rows: list[tuple[str, str, list[tuple[Topic, str, str]]]] = [
        ("position", unit, [
            (DESIRED, "positions", "nominal"), (JOINT_STATES, "position", "measured")]),
        ("response", f"{unit or '1'}{per}" if per else unit, [
            (DESIRED, "accelerations", "desired"), (COMMAND, "accelerations", "deformed"),
            (STATE_ESTIMATE, "accelerations", "observed")]),
        ("effort", effort, [
            (COMMAND, "effort", "commanded"), (JOINT_STATES, "effort", "acted")]),
    ]  # fmt: skip
    for quantity, of, wanted in rows:
        title = f"{quantity} of {name}" + (f" [{of}]" if of else "")
        known = [
            (topic, vector, word) for topic, vector, word in wanted if name in curves.names(topic)
        ]
        found = tuple(
            curves(topic, vector, name, f"{word} {title}") for topic, vector, word in known
        )
        yield Panel(title, found)
