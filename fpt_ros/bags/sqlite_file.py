"""Reading a .db3 file, as rosbag2 wrote it before MCAP."""

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from urllib.parse import quote

import numpy as np

from fpt_ros.bags.block import Block, Kind, Source
from fpt_ros.errors import BadInput

MAGIC = b"SQLite format 3\0"

_BATCH = 4096


class SqliteScan:
    """One pass over a .db3 file; attributes as of :class:`~fpt_ros.bags.scan.Scan`."""

    def __init__(self, path: Path, name: str) -> None:
        """``name``: of the file as its user knows it."""
        self.path, self._name = path, name
        self.kinds: dict[Source, Kind] = {}
        self.damage: list[str] = []
        self.cut = False

    def blocks(self) -> Iterator[Block]:
        """All messages.

        Raises:
            BadInput: it is not a rosbag2 file.
        """
        # beside a journal of its own sqlite has to recover first; else nothing is written here
        alone = not self.path.with_name(f"{self._name}-wal").exists()
        address = f"file:{quote(str(self.path.absolute()))}?mode=ro" + "&immutable=1" * alone
        try:
            with closing(sqlite3.connect(address, uri=True)) as bag:
                bag.text_factory = lambda raw: raw.decode(errors="replace")
                yield from self._read(bag)
        except sqlite3.DatabaseError as error:
            if not self.kinds:
                raise BadInput(f"{self._name} is not a rosbag2 file: {error}") from error
            self.damage.append(f"{self._name} is damaged: {error}")

    def _read(self, bag: sqlite3.Connection) -> Iterator[Block]:
        definitions = _definitions(bag)
        sources = {}
        for id, topic, type, encoding, qos in _topics(bag):
            source = sources[id] = Source(topic, type)
            form, text = definitions.get(type, ("", ""))
            metadata = {"offered_qos_profiles": qos}
            self.kinds[source] = Kind(encoding, form, text.encode(), metadata)
        rows = bag.execute("SELECT topic_id, timestamp, data FROM messages ORDER BY id")
        numbers = dict.fromkeys(sources.values(), 0)
        while some := rows.fetchmany(_BATCH):
            found: dict[Source, list[tuple[int, int, int, int]]] = {}
            data, at = [], 0
            for id, stamp, raw in some:
                if id not in sources or not isinstance(raw, bytes) or not isinstance(stamp, int):
                    self.damage.append(f"{self._name}: a message is not one, and is left out")
                    continue
                source = sources[id]
                found.setdefault(source, []).append((stamp, at, at + len(raw), numbers[source]))
                numbers[source] += 1
                data.append(raw)
                at += len(raw)
            yield Block(
                b"".join(data),
                {source: np.array(each, dtype=np.int64) for source, each in found.items()},
            )


def _topics(bag: sqlite3.Connection) -> list[tuple[int, str, str, str, str]]:
    columns = {row[1] for row in bag.execute("PRAGMA table_info(topics)")}
    qos = "offered_qos_profiles" if "offered_qos_profiles" in columns else "''"
    return list(bag.execute(f"SELECT id, name, type, serialization_format, {qos} FROM topics"))


def _definitions(bag: sqlite3.Connection) -> dict[str, tuple[str, str]]:
    """(form, text) by type; files before Jazzy hold none."""
    try:
        return {
            type: (form, text)
            for type, form, text in bag.execute(
                "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions"
            )
        }
    except sqlite3.OperationalError:
        return {}
