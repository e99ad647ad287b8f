"""Reading a recording back as the run that it is a recording of."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from fpt_ros.bags import changes, diagnostics, numbers, parameter_text
from fpt_ros.bags.bag import END, Bag
from fpt_ros.bags.block import Block, Source
from fpt_ros.bags.files import on_disk
from fpt_ros.bags.loop_series import loop_topic, series
from fpt_ros.bags.scan import CUT
from fpt_ros.bags.writer import INFO
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND
from fpt_ros.messages.topics import BY_NAME
from fpt_ros.parameters import Value, Values
from fpt_ros.runs.changes import Change
from fpt_ros.runs.chunks import CHUNK, Consumer, ordered
from fpt_ros.runs.chunks import rows as rows_of
from fpt_ros.runs.latency import Latencies
from fpt_ros.runs.run import Run, Series

Parameters = Mapping[str, Mapping[str, Value]]


def read_run(path: Path) -> Run:
    """Everything that a recording holds about its run.

    Of a recording that was cut or damaged all that is whole, in order; its ``info`` then has
    ``complete`` as ``false``, the ``reason``, and as ``missing`` what is not there.

    Args:
        path: the recording's directory, or one file of it.

    Raises:
        BadInput: not a recording of this package, or nothing in it can be read.
    """
    bag = Bag(path)
    aside = _Aside(bag)
    readings = numbers.read(bag, aside.is_of_the_loop, aside.take)
    parameters = _parameters(bag)
    about = _ending(bag)
    topics: dict[str, Series] = {}
    for topic in BY_NAME.values():
        for source, reading in readings.items():
            if loop_topic(source) is not topic or isinstance(reading, BadInput):
                continue
            found, bad = series(topic, reading)
            if bad:
                bag.missing.append(
                    f"{bad} messages on {source.topic} are not a {source.type} of the loop: one "
                    "number a name"
                )
            if len(found.stamps):
                topics[topic.name] = found
    _namespace(bag)
    if not topics and not bag.missing:
        loop = ", ".join(BY_NAME)
        raise BadInput(f"{path} holds no messages on the loop's topics: {loop}")
    return Run({**about, **_ending(bag)}, parameters, topics, aside.latency, tuple(aside.changes))


def play(path: Path, consumers: Callable[[Mapping[str, Values]], Sequence[Consumer]]) -> Run:
    """Give a recording's messages to consumers, chunk by chunk.

    Args:
        path: as :func:`read_run`.
        consumers: makes them of the run's parameters.

    Returns:
        All but the topics.

    Raises:
        BadInput: as :func:`read_run`.
    """
    run = read_run(path)
    taking, topics = consumers(run.parameters), ordered(run.topics)
    length = max((len(series.stamps) for series in topics.values()), default=0)
    for first in range(0, length, CHUNK):
        chunk = {name: rows_of(series, first, first + CHUNK) for name, series in topics.items()}
        for consumer in taking:
            consumer.take(chunk)
    return replace(run, topics={})


def info(path: Path) -> dict[str, object]:
    """What ``fpt info`` shows of a recording, whoever made it: plain values, as JSON has them.

    ``duration`` is in [s], ``start`` in [s] of the recording's clock, ``size`` in bytes on disk;
    ``missing`` says what is damaged or not there, ``complete`` that nothing is.

    Raises:
        BadInput: it is not a recording.
    """
    bag = Bag(path)
    first: int | None = None
    last = 0
    for block in bag.blocks():
        for rows in block.rows.values():
            if len(rows):
                low, high = int(rows[:, 0].min()), int(rows[:, 0].max())
                first = low if first is None else min(first, low)
                last = max(last, high)
    ours = parameter_text.NAME in bag.attachments
    parameters = _parameters(bag) if ours else {}
    known = _ending(bag)
    about = {key: known.get(key, "") for key in ("experiment", "variant", "engine")}
    rest = {key: value for key, value in known.items() if key not in about}
    return {
        "bag": str(path),
        **about,
        **rest,
        "version": known.get("version", ""),
        "namespace": _namespace(bag) if ours else known.get("namespace", ""),
        "complete": known["complete"] == "true",
        "reason": known["reason"],
        "missing": bag.missing,
        "notes": bag.notes,
        "start": None if first is None else first / SECOND,
        "duration": 0.0 if first is None else (last - first) / SECOND,
        "messages": sum(bag.counts.values()),
        "topics": {
            source.topic: {"type": source.type, "messages": bag.counts[source]}
            for source in bag.kinds
        },
        "files": [file.name for file in bag.files],
        "size": on_disk(path),
        "parameters": parameters,
    }


@dataclass
class _Aside:
    """What a run's recording holds beside the topics of its loop."""

    bag: Bag
    latency: Latencies | None = None
    changes: list[Change] = field(default_factory=list)

    def is_of_the_loop(self, source: Source) -> bool:
        """Whether it is a topic of the run's own loop."""
        namespace = self.bag.metadata.get(INFO, {}).get("namespace")
        own = namespace is None or _prefix(source) == namespace.strip("/")
        return loop_topic(source) is not None and own

    def take(self, block: Block) -> None:
        """Look for latencies and changes of parameters."""
        for source, rows in block.rows.items():
            told = source == Source(diagnostics.TOPIC, diagnostics.TYPE)
            if not told and (source.topic.rpartition("/")[2], source.type) != (
                changes.TOPIC,
                changes.TYPE,
            ):
                continue
            for stamp, start, end, _ in rows.tolist():
                data = bytes(block.data[start:end])
                try:
                    if told:
                        node = self._plant()
                        self.latency = diagnostics.latencies(data, node) or self.latency
                    else:
                        self.changes.append(changes.change(data))
                except BadInput as error:
                    raise BadInput(
                        f"{self.bag.path}: {source.topic} at {stamp / SECOND:g} s: {error}"
                    ) from error

    def _plant(self) -> str:
        namespace = self.bag.metadata.get(INFO, {}).get("namespace", "").strip("/")
        return f"{namespace}/{PlantSimulator.name}" if namespace else PlantSimulator.name


def _parameters(bag: Bag) -> dict[str, dict[str, Value]]:
    """Of all nodes, as the recording holds them.

    Raises:
        BadInput: it holds none.
    """
    text = bag.attachments.get(parameter_text.NAME)
    where = str(bag.path if len(bag.files) > 1 else bag.files[0])
    if text is None:
        raise BadInput(
            f"{where} is not whole, and ends before the parameters: nothing can be read"
            if bag.missing and not (bag.kinds or bag.attachments)
            else f"{where} holds no parameters: it has to be a recording of this package"
        )
    return parameter_text.from_text(text, where)


def _ending(bag: Bag) -> dict[str, str]:
    """What the recording says of itself, with how it ended."""
    about = {**bag.metadata.get(INFO, {})}
    end = bag.metadata.get(END, {})
    if bag.missing:
        return {
            **about,
            "complete": "false",
            "reason": bag.reason,
            "missing": "; ".join(bag.missing),
        }
    if about and not end:
        return {**about, "complete": "false", "reason": CUT}
    if not about and not end:
        return {"complete": "true", "reason": ""}
    complete, reason = end.get("complete", "false"), end.get("reason", "")
    return {**about, "complete": complete, "reason": reason}


def _prefix(source: Source) -> str:
    return source.topic.rpartition("/")[0].strip("/")


def _namespace(bag: Bag) -> str:
    """The one namespace whose loop is recorded, as in ``/robot1``; ``/`` for none."""
    found = {_prefix(source) for source in bag.kinds if loop_topic(source)}
    given = bag.metadata.get(INFO, {}).get("namespace")
    if given is not None:
        found = {given.strip("/")}
    if len(found) > 1:
        names = ", ".join(f"/{name}" for name in sorted(found))
        raise BadInput(f"{bag.path} holds the loops of {names}: record one namespace a bag")
    return f"/{found.pop()}" if found else "/"
