"""rosbag2's older files: whole, compressed and cut."""

import sqlite3
from pathlib import Path

import pytest
import zstandard
from damaged import STEP, positions, states

from fpt_ros.errors import BadInput
from fpt_ros.messages.topics import JOINT_STATE


@pytest.fixture
def db3(tmp_path: Path) -> Path:
    path = tmp_path / "old" / "old_0.db3"
    path.parent.mkdir()
    with sqlite3.connect(path) as bag:
        bag.executescript(
            "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, "
            "serialization_format TEXT, offered_qos_profiles TEXT);"
            "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, "
            "data BLOB);"
        )
        bag.execute("INSERT INTO topics VALUES(1, '/joint_states', ?, 'cdr', '')", (JOINT_STATE,))
        rows = [(1, k * STEP, states(k)) for k in range(500)]
        bag.executemany("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", rows)
    bag.close()
    return path


def test_sqlite(db3: Path) -> None:
    for way in (db3, db3.parent):
        found, bag = positions(way)
        assert found == [float(k) for k in range(500)]
        assert bag.missing == []
    assert [each.name for each in db3.parent.iterdir()] == ["old_0.db3"]  # nothing is left there
    packed = db3.parent.with_name("packed") / "old_0.db3.zstd"
    packed.parent.mkdir()
    packed.write_bytes(zstandard.compress(db3.read_bytes()))
    assert len(positions(packed)[0]) == 500


def test_cut_sqlite(db3: Path, tmp_path: Path) -> None:
    data = db3.read_bytes()
    for size in (10, 100, 5000, 20_000, len(data) - 4096):
        path = tmp_path / "cut.db3"
        path.write_bytes(data[:size])
        try:
            found, bag = positions(path)
        except BadInput:
            continue
        assert bag.missing
        assert found == [float(k) for k in range(len(found))]
