"""A motion from a file: columns of a table (CSV and others), or joints of a recording.

Its samples are the points of a spline of degree 5, at rest at both ends
(:mod:`fpt_ros.trajectories.quintic_pieces`): give few and smooth ones, or take every so many of
them with ``every``, as its acceleration goes through every wiggle. Time counts from the first one.
"""

from pathlib import Path
from typing import TYPE_CHECKING

from fpt_ros.errors import BadInput
from fpt_ros.parameters import Parameter, Values, flag, integer, word, words
from fpt_ros.trajectories import Trajectory, scales
from fpt_ros.trajectories.quintic_pieces import constants_of, nominal

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Times = Array

PARAMETERS = (
    Parameter("file", "a table, or a recording", kind="str", live=False),
    Parameter("time", "column of the times; empty: found by its name", "", live=False),
    Parameter(
        "columns",
        "of the table, or joints of the recording; empty: named as those controlled",
        [],
        kind="strings",
        live=False,
    ),
    Parameter("topic", "of a recording", "joint_states", live=False),
    Parameter("field", "of its messages", "position", live=False),
    Parameter("every", "take only every so many samples", 1, minimum=1, live=False),
    Parameter("repeat", "begin anew behind the last sample", False),
)

MOST = 200_000
"""Samples of a coordinate that are taken at most."""


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants of the pieces.

    Raises:
        BadInput: the file cannot be read, or is no motion of c coordinates.
    """
    path = Path(word(values, "file"))
    names = words(values, "columns") or words(values, "controlled")
    if len(names) != c:
        raise BadInput(f"trajectory_generator.columns: {len(names)} given, {c} needed")
    if not path.exists():
        raise BadInput(f"trajectory_generator.file: {path} does not exist")
    read = _of_recording if path.is_dir() or path.suffix in RECORDINGS else _of_table
    times, points = read(path, names, values)
    every = integer(values, "every")
    times, points = times[::every], [each[::every] for each in points]
    _check(path, times, points, names)
    since = (times - times[0]).tolist()
    return constants_of(
        scales(values, c), flag(values, "repeat"), since, [each.tolist() for each in points]
    )


RECORDINGS = (".mcap", ".bag", ".db3")


def _of_table(path: Path, names: list[str], values: Values) -> "tuple[Times, list[Array]]":
    from fpt_ros.tables.reading import read
    from fpt_ros.tables.time_axis import find

    table = read(path)
    axis = find(table, word(values, "time") or None, names)
    if axis is None:
        raise BadInput(f"{path} has no column of times: trajectory_generator.time names one")
    seconds = axis.values * (axis.second or 1.0)
    return seconds, [table.column(name).numbers() for name in names]


def _of_recording(path: Path, names: list[str], values: Values) -> "tuple[Times, list[Array]]":
    from fpt_ros.bags.one_field import read_field

    topic, field = word(values, "topic"), word(values, "field")
    found = [read_field(path, topic, field, name) for name in names]
    if any(len(each.stamps) != len(found[0].stamps) for each in found):
        raise BadInput(f"{path}: {topic} has more messages of {names[0]} than of another joint")
    return found[0].stamps / 1e9, [each.values for each in found]


def _check(path: Path, times: "Times", points: "list[Array]", names: list[str]) -> None:
    import numpy as np

    if not 2 <= len(times) <= MOST:
        raise BadInput(
            f"{path} has {len(times)} samples, it takes 2 to {MOST:,}: "
            "trajectory_generator.every leaves some out"
        )
    late = np.flatnonzero(~(np.diff(times) > 0.0))
    if len(late):
        raise BadInput(f"{path}: the time of sample {late[0] + 2} is not behind that before it")
    for name, each in zip(names, points, strict=True):
        gaps = np.flatnonzero(~np.isfinite(each))
        if len(gaps):
            raise BadInput(
                f"{path}: sample {gaps[0] + 1} of '{name}' is missing: a motion needs all of them "
                "(fpt denoise fills gaps)"
            )


RECORDED = Trajectory(prepare, nominal, PARAMETERS)
