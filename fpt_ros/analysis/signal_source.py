"""Signals to be denoised: columns of a table, a field of a recording, or a test signal."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from fpt_ros.bags.files import METADATA, SUFFIXES
from fpt_ros.denoising.noisy import EXAMPLE, PREFIX, parse
from fpt_ros.errors import BadInput
from fpt_ros.runs.run import Array
from fpt_ros.tables import headings
from fpt_ros.tables.opening import STDIN
from fpt_ros.tables.reading import TAKES, read
from fpt_ros.tables.spacing import Spacing, spacing_of
from fpt_ros.tables.table import Column, Kind, Table
from fpt_ros.tables.time_axis import NONE, TimeAxis, find, unread

ALL = "all"
"""The word for every column of numbers but the times."""


@dataclass(frozen=True)
class Request:
    """Which signals of which file.

    Attributes:
        path: a table, ``-`` for standard input, a recording's directory or file, or the word for a
            test signal (:mod:`~fpt_ros.denoising.noisy`).
        columns: names, or ``all``; where none is given the last one with numbers.
        topic, field: of a recording, as in ``/joint_states`` and ``position[2]``.
        joint: of a recording, by name; ``field`` then is ``position``, without an index.
        time: name of the column of times, or ``none``; where it is not given it is looked for. Of a
            recording the field of a message that tells its time, as ``header.stamp``.
    """

    path: Path
    columns: tuple[str, ...] = ()
    topic: str | None = None
    field: str | None = None
    time: str | None = None
    joint: str | None = None


@dataclass(frozen=True)
class Source:
    """Signals and where they come from.

    Attributes:
        table: the signals stand in it, n rows.
        signals: its columns that are to be denoised.
        axis: the times of the rows; ``None`` where there are none.
        spacing: how the rows lie in time.
        path: where from; of a test signal its name.
        clean: the signal without its noise (n,), where it is known.
    """

    table: Table
    signals: tuple[Column, ...]
    axis: TimeAxis | None
    spacing: Spacing
    path: Path
    clean: Array | None = None


def load(request: Request, done: Callable[[int], None] = lambda _: None) -> Source:
    """Read signals.

    Args:
        request: which.
        done: is told how many bytes of a text have been read.

    Raises:
        BadInput: they cannot be read, or a column, topic or field is not there (lists what is).
    """
    path = request.path
    recorded = (request.topic, request.field, request.joint) != (None, None, None)
    if str(path).startswith(PREFIX):
        if request.columns or recorded or request.time:
            raise BadInput(
                f"{path} is one signal: it takes no --column, --topic, --field, --joint, --time"
            )
        return _test_signal(str(path))
    if str(path) != STDIN and not path.exists():
        raise BadInput(
            f"{path} does not exist: it takes a table ({TAKES}), a recording, or a test signal, as "
            f"in {EXAMPLE}"
        )
    if path.is_dir() or path.name.endswith((*SUFFIXES, ".bag", METADATA)):
        return _recorded(request)
    if recorded:
        raise BadInput("--topic, --field and --joint are for recordings: a table takes --column")
    wanted = request.columns[0] if request.columns and ALL not in request.columns else None
    return _of_table(read(path, wanted, done), request)


def _recorded(request: Request) -> Source:
    from fpt_ros.analysis.recorded_signal import read_recording

    if request.topic is None or request.field is None:
        raise BadInput(f"{request.path} is a recording: --topic and --field say which signal")
    if request.columns:
        raise BadInput(f"{request.path} is a recording: it takes --topic and --field, no --column")
    own = request.time in (None, NONE, "time")
    clock = "" if own or request.time is None else request.time
    table = read_recording(request.path, request.topic, request.field, request.joint, clock)
    return _of_table(table, request if own else replace(request, time=None))


def _of_table(table: Table, request: Request) -> Source:
    named = [] if ALL in request.columns else list(dict.fromkeys(request.columns))
    signals = tuple(table.column(name) for name in named)
    axis = find(table, request.time, [each.name for each in signals])
    if not signals:
        signals = _signals(table, axis)
        signals = signals if ALL in request.columns else signals[-1:]
    for each in signals:
        if not each.numeric:
            names = ", ".join(one.title for one in table.columns if one.numeric) or "none"
            raise BadInput(f"{table.name}: {each.refusal}: columns of numbers are {names}")
        if each.refusal:
            raise BadInput(f"{table.name}: {each.refusal}")
    if axis is None and request.time is None and unread(table):
        table = replace(table, remarks=(*table.remarks, unread(table)))
    return Source(table, signals, axis, spacing_of(table, axis), request.path)


def _signals(table: Table, axis: TimeAxis | None) -> tuple[Column, ...]:
    """Every column of numbers that is neither times nor a count of the rows, and not empty.

    True and false are numbers where there are no others.
    """
    others = [
        each
        for each in table.columns
        if each.kind in (Kind.NUMBER, Kind.BOOL) and (axis is None or each.name != axis.column)
    ]
    found = [
        each
        for each in others
        if axis is None or not (headings.is_time_name(each.name) or _counts(each))
    ]
    found = [each for each in found if each.kind is Kind.NUMBER] or found
    filled = [each for each in found if 2 * int(np.isnan(each.values).sum()) <= len(table)]
    if filled or found or others:
        return tuple(filled or found or others)
    refused = [each.refusal for each in table.columns if each.refusal]
    why = f": {refused[-1]}" if refused else ""
    if axis is None:
        raise BadInput(f"{table.name} has no column of numbers{why}")
    raise BadInput(
        f"{table.name} has no column of numbers but the times '{axis.column}'{why}"
        + ("" if refused else f": --column {axis.column} takes them as the signal")
    )


def _counts(column: Column) -> bool:
    return headings.is_index_name(column.name) and bool(np.all(np.diff(column.values) == 1))


def _test_signal(text: str) -> Source:
    noisy = parse(text)
    clean, y = noisy.clean(), noisy.samples()
    signal = Column(noisy.signal, Kind.NUMBER, y, heading="y")
    time = Column("t", Kind.NUMBER, np.arange(noisy.n) / noisy.n)
    table = Table((time, Column("clean", Kind.NUMBER, clean), signal), text, "test signal")
    axis = TimeAxis("t", time.values, "")
    return Source(table, (signal,), axis, spacing_of(table, axis), Path(noisy.signal), clean)
