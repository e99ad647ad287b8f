"""Recordings as other programs read them: by topic the number of messages, and digests.

A digest is of all numbers as doubles, another one of all words, in the order of the messages and
of their fields; NaN is NaN whatever its payload.
"""

import dataclasses
import hashlib
import json
import shutil
import subprocess
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap_ros2.reader import read_ros2_messages
from rosbags.highlevel import AnyReader

from fpt_ros.bags import numbers
from fpt_ros.bags.bag import Bag

NODE = Path(__file__).with_name("node_reader")

Digests = dict[str, tuple[int, str, str]]


class _Digest:
    def __init__(self) -> None:
        self.count, self.numbers, self.words = 0, hashlib.sha256(), hashlib.sha256()

    def add(self, message: object) -> None:
        self.count += 1
        found: list[float] = []
        words: list[str] = []
        _collect(message, found, words)
        self.numbers.update(_canonical(np.array(found, dtype=float)).tobytes())
        self.words.update("".join(f"{word}\n" for word in words).encode())


def _collect(value: Any, found: list[float], words: list[str]) -> None:
    """Numbers and words of a message, in the order of its fields."""
    if isinstance(value, (int, float)):
        found.append(value)
    elif isinstance(value, str):
        words.append(value)
    elif isinstance(value, (np.ndarray, bytes)):
        found.extend(value)
    elif isinstance(value, list):
        for each in value:
            _collect(each, found, words)
    else:
        for name in _names(type(value)):
            _collect(getattr(value, name), found, words)


@cache
def _names(kind: type) -> list[str]:
    names = (
        [field.name for field in dataclasses.fields(kind)]
        if dataclasses.is_dataclass(kind)
        else kind.__slots__  # type: ignore[attr-defined]
    )
    return [name for name in names if name[0] != "_" and not name.isupper()]  # no constants


def _canonical(found: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    return np.where(np.isnan(found), np.nan, found)


def _result(digests: dict[str, _Digest]) -> Digests:
    return {
        topic: (each.count, each.numbers.hexdigest(), each.words.hexdigest())
        for topic, each in digests.items()
    }


def by_rosbags(directory: Path) -> Digests:
    digests: dict[str, _Digest] = {}
    with AnyReader([directory]) as bag:
        for connection, _, raw in bag.messages():
            digest = digests.setdefault(connection.topic, _Digest())
            digest.add(bag.deserialize(raw, connection.msgtype))
    return _result(digests)


def by_mcap(files: list[Path]) -> Digests:
    """By mcap with mcap-ros2-support."""
    digests: dict[str, _Digest] = {}
    for path in files:
        for item in read_ros2_messages(str(path)):
            digests.setdefault(item.channel.topic, _Digest()).add(item.ros_msg)
    return _result(digests)


def by_node(groups: list[list[Path]]) -> list[Digests]:
    """By @mcap/core and @foxglove/rosmsg2-serialization, which Foxglove and Lichtblick use."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("there is no node")
    if not (NODE / "node_modules").is_dir():
        pytest.skip(f"the readers for node are not installed: npm ci --prefix {NODE}")
    asked = json.dumps([[str(path) for path in files] for files in groups])
    command = [node, NODE / "read.mjs", asked]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return [
        {topic: (each[0], each[1], each[2]) for topic, each in found.items()}
        for found in json.loads(done.stdout)
    ]


def by_us(path: Path) -> Digests:
    digests: Digests = {}
    for source, reading in numbers.read(Bag(path), lambda source: True).items():
        assert isinstance(reading, numbers.Reading), reading
        assert reading.bad == 0
        rows: list[tuple[bytes, bytes]] = [(b"", b"")] * len(reading.stamps)
        for part in reading.parts:
            leaves = [part.numbers[leaf.path].astype(float) for leaf in part.layout.leaves]
            whole = _canonical(np.hstack(leaves)) if leaves else np.empty((len(part.at), 0))
            words = "".join(f"{word}\n" for word in part.layout.texts.values()).encode()
            for at, row in zip(part.at.tolist(), whole, strict=True):
                rows[at] = row.tobytes(), words
        digests[source.topic] = (
            len(rows),
            hashlib.sha256(b"".join(row for row, _ in rows)).hexdigest(),
            hashlib.sha256(b"".join(words for _, words in rows)).hexdigest(),
        )
    return digests
