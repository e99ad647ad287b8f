"""Signals to be denoised: from a table, an array, a topic of any recording, or a test signal."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from fpt_ros.denoising.noisy import EXAMPLE, PREFIX, parse
from fpt_ros.errors import BadInput
from fpt_ros.runs.run import Array

if TYPE_CHECKING:
    import pandas as pd

STEP = re.compile(r"\w+|\[\d+\]")
"""A step of a field's path: a name, or an index."""


@dataclass(frozen=True)
class Source:
    """A signal and where it comes from.

    Attributes:
        values: (n,), NaN where a sample is missing.
        name: of the column or field.
        table: what it stands in, n rows; the results become its last columns.
        path: where from; of a test signal its name.
        clean: the signal without its noise (n,), where it is known.
    """

    values: Array
    name: str
    table: "pd.DataFrame"
    path: Path
    clean: Array | None = None


def load(path: Path, column: str | None, topic: str | None, field: str | None) -> Source:
    """Read a signal.

    Args:
        path: a CSV or NPY file, a recording's directory, an MCAP file, or the word for a test
            signal (:mod:`~fpt_ros.denoising.noisy`).
        column: name or index of a column; the last one with numbers where it is not given.
        topic, field: of a recording, as in ``/joint_states`` and ``position[2]``.

    Raises:
        BadInput: it cannot be read, or the column, topic or field is not there (lists what is).
    """
    if str(path).startswith(PREFIX):
        if (column, topic, field) != (None, None, None):
            raise BadInput(f"{path} is one signal: it takes no --column, --topic and --field")
        return _test_signal(str(path))
    if not path.exists():
        raise BadInput(
            f"{path} does not exist: it takes a CSV or NPY file, a recording, or a test signal, as "
            f"in {EXAMPLE}"
        )
    if path.is_dir() or path.suffix == ".mcap":
        if topic is None or field is None:
            raise BadInput(f"{path} is a recording: --topic and --field say which signal")
        return _recording(path, topic, field)
    if topic is not None or field is not None:
        raise BadInput("--topic and --field are for recordings: a table takes --column")
    return _column(path, _table(path), column)


def _test_signal(text: str) -> Source:
    import pandas as pd

    noisy = parse(text)
    clean, y = noisy.clean(), noisy.samples()
    time = np.arange(noisy.n) / noisy.n
    table = pd.DataFrame({"t": time, "clean": clean, "y": y})
    return Source(y, noisy.signal, table, Path(noisy.signal), clean)


def _table(path: Path) -> "pd.DataFrame":
    import pandas as pd

    try:
        if path.suffix == ".npy":
            array = np.load(path, allow_pickle=False)
            if array.ndim not in (1, 2):
                raise BadInput(f"{path}: {array.ndim} dimensions, 1 or 2 are needed")
            return pd.DataFrame(array)
        first = pd.read_csv(path, nrows=1, header=None)
        named = not all(isinstance(x, int | float | np.number) for x in first.iloc[0])
        return pd.read_csv(path, header=0 if named else None)
    except BadInput:
        raise
    except pd.errors.EmptyDataError as error:
        raise BadInput(f"{path} is empty: it takes a table with one signal a column") from error
    except (OSError, ValueError, UnicodeDecodeError) as error:
        raise BadInput(f"{path} cannot be read as a table: {str(error).splitlines()[0]}") from error


def _column(path: Path, table: "pd.DataFrame", column: str | None) -> Source:
    numeric = [name for name in table.columns if table[name].dtype.kind in "fiub"]
    names = ", ".join(str(name) for name in numeric) or "none"
    if column is None:
        if not numeric:
            raise BadInput(f"{path} has no column of numbers")
        chosen: Any = numeric[-1]
    else:
        known = {str(name): name for name in table.columns}
        if column not in known:
            raise BadInput(f"{path} has no column '{column}': columns of numbers are {names}")
        chosen = known[column]
        if chosen not in numeric:
            raise BadInput(f"{path}: column '{column}' is not numbers: columns of them are {names}")
    return Source(table[chosen].to_numpy(dtype=np.float64), str(chosen), table, path)


def _recording(path: Path, topic: str, field: str) -> Source:
    import pandas as pd
    from rosbags.highlevel import AnyReader, AnyReaderError
    from rosbags.typesys import Stores, get_typestore

    try:
        with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as bag:
            wanted = {topic, f"/{topic.lstrip('/')}"}
            connections = [each for each in bag.connections if each.topic in wanted]
            if not connections:
                names = ", ".join(sorted({each.topic for each in bag.connections}))
                raise BadInput(f"{path} has no topic '{topic}': there are {names}")
            times, values = [], []
            for connection, stamp, raw in bag.messages(connections=connections):
                message = bag.deserialize(raw, connection.msgtype)
                times.append(stamp / 1e9)
                values.append(_follow(message, field, topic))
    except (AnyReaderError, OSError) as error:
        raise BadInput(f"{path} cannot be read as a recording: {error}") from error
    if not values:
        raise BadInput(f"{path} has no messages on {topic}")
    name = f"{topic}.{field}"
    return Source(np.array(values), name, pd.DataFrame({"time": times, name: values}), path)


def _follow(message: Any, field: str, topic: str) -> float:
    at = message
    for step in _steps(field):
        if step.startswith("["):
            index = int(step[1:-1])
            if not hasattr(at, "__len__") or index >= len(at):
                raise BadInput(f"--field {field}: {topic} has no element {step} there")
            at = at[index]
        elif hasattr(at, step):
            at = getattr(at, step)
        else:
            names = ", ".join(n for n in vars(at) if not n.startswith("_")) or "nothing below it"
            raise BadInput(f"--field {field}: {topic} has no '{step}', it has {names}")
    try:
        return float(at)
    except (TypeError, ValueError):
        hint = ", as in position[0]" if hasattr(at, "__len__") else ""
        raise BadInput(f"--field {field} of {topic} is not one number{hint}") from None


def _steps(field: str) -> Iterator[str]:
    steps = STEP.findall(field)
    if not steps or "".join(steps) != field.replace(".", ""):
        raise BadInput(f"--field {field} is not a path like points[0].positions[1]")
    yield from steps
