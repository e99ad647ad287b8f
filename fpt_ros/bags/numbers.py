"""The numbers of a recording's topics as arrays, read many messages at a time."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fpt_ros.bags import definitions, json_text
from fpt_ros.bags.bag import Bag
from fpt_ros.bags.block import Block, Rows, Source
from fpt_ros.bags.layout import Bytes, Layout, Malformed, layout
from fpt_ros.errors import BadInput

MANY = 1024
"""Numbers of one field and more are left out: pictures and point clouds are no signals."""

_FEW = 4
"""Messages that a layout has to fit, or the next messages are looked at one by one."""


@dataclass
class Part:
    """Messages of one layout, m of the topic's n.

    Attributes:
        layout: where their numbers stand.
        at: (m,) their places among the topic's messages.
        numbers: by path: (m, count), of a field that is one number (m, 1).
    """

    layout: Layout
    at: NDArray[np.int64]
    numbers: dict[str, NDArray[Any]]


@dataclass
class Reading:
    """All messages of one topic.

    Attributes:
        stamps: (n,) log times [ns].
        parts: their numbers; messages that could not be read are in none.
        bad: messages that could not be read.
        left_out: fields of :data:`MANY` numbers and more.
    """

    stamps: NDArray[np.int64]
    parts: list[Part]
    bad: int = 0
    left_out: set[str] = field(default_factory=set)


def read(
    bag: Bag,
    wanted: Callable[[Source], bool],
    beside: Callable[[Block], None] | None = None,
) -> dict[Source, Reading | BadInput]:
    """The numbers of the wanted topics, in one pass over the recording.

    Args:
        bag: the recording.
        wanted: whether a topic is; asked once, when its first message comes.
        beside: is shown every block of messages too.

    Returns:
        By topic; an error where its messages are of a kind that is not read here.
    """
    gatherers: dict[Source, _Gatherer | BadInput] = {}
    asked: set[Source] = set()
    for block in bag.blocks():
        if beside is not None:
            beside(block)
        for source, rows in block.rows.items():
            if source not in gatherers:
                if source in asked or not wanted(source):
                    asked.add(source)
                    continue
                gatherers[source] = _gatherer(bag, source)
            gatherer = gatherers[source]
            if isinstance(gatherer, _Gatherer):
                gatherer.take(block, rows)
    return {
        source: each.reading() if isinstance(each, _Gatherer) else each
        for source, each in gatherers.items()
    }


def _gatherer(bag: Bag, source: Source) -> "_Gatherer | BadInput":
    kind = bag.kinds[source]
    if kind.encoding == "json":
        return _Gatherer(json_text.layout)
    try:
        known = definitions.of(source, kind)
    except BadInput as error:
        return error
    name = definitions.full_name(source.type)
    return _Gatherer(lambda data: layout(name, known, data))


class _Gatherer:
    """Reads the messages of one topic as they come."""

    def __init__(self, describe: Callable[[bytes], Any]) -> None:
        self._describe = describe
        self._stamps: list[NDArray[np.int64]] = []
        self._layouts: list[Layout] = []
        self._found: list[list[tuple[NDArray[np.int64], list[NDArray[Any]]]]] = []
        self._common: dict[int, list[int]] = {}
        self._count = 0
        self._bad = 0

    def take(self, block: Block, rows: Rows) -> None:
        """The topic's messages of one block."""
        self._stamps.append(rows[:, 0])
        data = np.frombuffer(block.data, dtype=np.uint8)
        lengths = rows[:, 2] - rows[:, 1]
        for length in np.unique(lengths).tolist():
            at = np.flatnonzero(lengths == length)
            self._of_one_length(_rows(data, rows[at, 1], length), at + self._count)
        self._count += len(rows)

    def _of_one_length(self, messages: Bytes, at: NDArray[np.int64]) -> None:
        size = messages.shape[1]
        for number in self._common.get(size, ()):
            if len(at):
                messages, at = self._keep(number, messages, at)
        while len(at):
            try:
                new = self._describe(messages[0].tobytes())
            except Malformed:
                self._bad += 1
                messages, at = messages[1:], at[1:]
                continue
            number = len(self._layouts)
            self._layouts.append(new)
            self._found.append([])
            if self._fits_many(new, messages):
                self._common.setdefault(size, []).append(number)
                messages, at = self._keep(number, messages, at)
            else:  # other words in each message: it is not tried on all the rest
                self._keep(number, messages[:1], at[:1])
                messages, at = messages[1:], at[1:]

    def _fits_many(self, new: Layout, messages: Bytes) -> bool:
        return int(new.fits(messages[: 4 * _FEW]).sum()) >= min(_FEW, len(messages))

    def _keep(
        self, number: int, messages: Bytes, at: NDArray[np.int64]
    ) -> tuple[Bytes, NDArray[np.int64]]:
        """Read the messages that a layout fits; gives the others."""
        known = self._layouts[number]
        fits = known.fits(messages)
        if fits.any():
            own = messages if fits.all() else messages[fits]
            numbers = [
                known.numbers(own, leaf) for leaf in known.leaves if (leaf.length or 1) < MANY
            ]
            self._found[number].append((at[fits], numbers))
        return messages[~fits], at[~fits]

    def reading(self) -> Reading:
        """All that has been taken."""
        stamps = np.concatenate(self._stamps) if self._stamps else np.empty(0, dtype=np.int64)
        parts, left_out = [], set()
        for known, found in zip(self._layouts, self._found, strict=True):
            kept = [leaf for leaf in known.leaves if (leaf.length or 1) < MANY]
            left_out |= {leaf.path for leaf in known.leaves if leaf not in kept}
            columns = zip(*[numbers for _, numbers in found], strict=True)
            parts.append(
                Part(
                    known,
                    np.concatenate([at for at, _ in found]),
                    {
                        leaf.path: _native(np.concatenate(each), leaf.is_bool)
                        for leaf, each in zip(kept, columns, strict=True)
                    },
                )
            )
        return Reading(stamps, parts, self._bad, left_out)


def _rows(data: Bytes, starts: NDArray[np.int64], size: int) -> Bytes:
    """(n, size) bytes from each start on."""
    if not size or not len(starts):
        return np.empty((len(starts), size), dtype=np.uint8)
    windows = np.lib.stride_tricks.sliding_window_view(data, size)
    rows: Bytes = windows[starts]
    return rows


def _native(numbers: NDArray[Any], is_bool: bool) -> NDArray[Any]:
    if is_bool:
        truth: NDArray[Any] = numbers != 0
        return truth
    return numbers.astype(numbers.dtype.newbyteorder("="), copy=False)
