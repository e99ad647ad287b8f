"""Reading a recording back as the run that it is a recording of."""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from fpt_ros.bags import diagnostics, parameter_text
from fpt_ros.bags.player import Player
from fpt_ros.bags.scan import CUT, DAMAGED, Item, Scan, Source, files
from fpt_ros.bags.writer import END, INFO
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.errors import BadInput
from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import SECOND
from fpt_ros.messages.topics import BY_NAME, Topic
from fpt_ros.parameters import Value, Values
from fpt_ros.runs.chunks import Consumer
from fpt_ros.runs.latency import Latencies
from fpt_ros.runs.run import Collector, Run


@dataclass
class _Recording:
    """All files of a recording as one stream of messages, and what else they hold."""

    path: Path
    info: dict[str, str] = field(default_factory=dict)
    parameters: dict[str, dict[str, Value]] | None = None
    sources: dict[Source, None] = field(default_factory=dict)
    files: list[Path] = field(default_factory=list)
    whole: bool = False

    def messages(self) -> Iterator[Item]:
        """Every message; when it is through, all else is known too.

        Raises:
            BadInput: not recordings, or the parameters are not in them.
        """
        endings, ends = [], []
        self.files = files(self.path)
        for file in self.files:
            scan = Scan(file)
            for item in scan.messages():
                if self.parameters is None:
                    self._begin(scan)
                yield item
            if self.parameters is None:
                self._begin(scan)
            self.sources.update(scan.sources)
            endings.append(scan.ending)
            ends.append(scan.metadata.get(END, {}))
        self._end(endings, ends)

    def _begin(self, scan: Scan) -> None:
        """Take what stands in front of the messages."""
        text = scan.attachments.get(parameter_text.NAME)
        if text is None:
            raise BadInput(
                f"{scan.path} is not whole, and ends before the parameters: nothing can be read"
                if scan.ending and not (scan.sources or scan.attachments)
                else f"{scan.path} holds no parameters: it has to be a recording of this package"
            )
        self.parameters = parameter_text.from_text(text, str(scan.path))
        self.info.update(scan.metadata.get(INFO, {}))

    def _end(self, endings: list[str], ends: list[dict[str, str]]) -> None:
        self.whole, end = not any(endings), ends[-1]
        if DAMAGED in endings:
            complete, reason = "false", DAMAGED
        elif not end or CUT in endings[:-1]:
            complete, reason = "false", CUT
        else:
            complete, reason = end.get("complete", "false"), end.get("reason", "")
        self.info.update(complete=complete, reason=reason)


def read_run(path: Path) -> Run:
    """Everything that a recording holds about its run.

    Of a recording that was cut or damaged, what comes before that, with ``complete`` in its
    ``info`` as ``false`` and the ``reason``.

    Args:
        path: the recording's directory, or its ``.mcap`` file.

    Raises:
        BadInput: not a recording of this package, or not one that can be read.
    """
    collector = Collector()
    about = _read(path, collector)
    return replace(about, topics=collector.topics())


def play(path: Path, consumers: Callable[[Mapping[str, Values]], Sequence[Consumer]]) -> Run:
    """Give a recording's messages to consumers, chunk by chunk, in constant memory.

    Args:
        path: as :func:`read_run`.
        consumers: makes them of the run's parameters.

    Returns:
        All but the topics.

    Raises:
        BadInput: as :func:`read_run`; some cycles may have been taken by then.
    """
    player = Player(consumers)
    about = _read(path, player)
    player.finish(about.parameters)
    return about


def _read(path: Path, take: Collector | Player) -> Run:
    """Decode the messages of a recording, one by one; all of its run but the topics."""
    recording = _Recording(path)
    decoders: dict[Source, tuple[Topic, Codec] | None] = {}
    latency: Latencies | None = None
    for source, stamp, data in recording.messages():
        if source not in decoders:
            decoders[source] = _decoder(source, recording)
        decoder = decoders[source]
        if decoder is not None:
            if isinstance(take, Player):
                take.begin(recording.parameters or {})
            topic, codec = decoder
            try:
                frame = codec.decode(data)
            except MalformedMessage as error:
                raise _malformed(path, source, stamp) from error
            count = len(frame.names)
            if any(len(vector) != count for vector in frame[2:]):
                raise _malformed(path, source, stamp)
            take(topic, frame)
        elif source == Source(diagnostics.TOPIC, diagnostics.TYPE):
            latency = _latency(recording, stamp, data) or latency
    _namespace(recording)
    if recording.whole and not any(decoders.values()):
        loop = ", ".join(BY_NAME)
        raise BadInput(f"{path} holds no messages on the loop's topics: {loop}")
    assert recording.parameters is not None
    return Run(recording.info, recording.parameters, {}, latency)


def info(path: Path) -> dict[str, object]:
    """What ``fpt info`` shows: plain values, as JSON has them.

    ``duration`` is in [s], ``start`` in [s] of the run's clock, ``size`` in bytes on disk.

    Raises:
        BadInput: as :func:`read_run`, but messages are counted only, and there may be none.
    """
    recording, counts = _Recording(path), Counter[Source]()
    first: int | None = None
    last = 0
    for source, stamp, _ in recording.messages():
        counts[source] += 1
        first = stamp if first is None else min(first, stamp)
        last = max(last, stamp)
    namespace = _namespace(recording)
    about = {key: recording.info.get(key, "") for key in ("experiment", "variant", "engine")}
    rest = {key: value for key, value in recording.info.items() if key not in about}
    return {
        "bag": str(path),
        **about,
        **rest,
        "version": recording.info.get("version", ""),
        "namespace": namespace,
        "complete": recording.info["complete"] == "true",
        "reason": recording.info["reason"],
        "start": None if first is None else first / SECOND,
        "duration": 0.0 if first is None else (last - first) / SECOND,
        "messages": sum(counts.values()),
        "topics": {
            source.topic: {"type": source.type, "messages": counts[source]}
            for source in recording.sources
        },
        "files": [file.name for file in recording.files],
        "size": sum(file.stat().st_size for file in _on_disk(path)),
        "parameters": recording.parameters,
    }


def _decoder(source: Source, recording: _Recording) -> tuple[Topic, Codec] | None:
    """Of a topic of the run's loop; ``None`` for all others."""
    topic = _loop_topic(source)
    namespace = recording.info.get("namespace")
    if topic is None or (namespace is not None and _prefix(source) != namespace.strip("/")):
        return None
    return topic, Codec(topic)


def _latency(recording: _Recording, stamp: int, data: bytes) -> Latencies | None:
    """What the plant simulator of this loop tells in a message of /diagnostics."""
    namespace = recording.info.get("namespace", "").strip("/")
    node = f"{namespace}/{PlantSimulator.name}" if namespace else PlantSimulator.name
    try:
        return diagnostics.latencies(data, node)
    except BadInput as error:
        where = f"{diagnostics.TOPIC} at {stamp / SECOND:g} s"
        raise BadInput(f"{recording.path}: {where}: {error}") from error


def _loop_topic(source: Source) -> Topic | None:
    topic = BY_NAME.get(source.topic.rpartition("/")[2])
    return topic if topic is not None and topic.type == source.type else None


def _prefix(source: Source) -> str:
    return source.topic.rpartition("/")[0].strip("/")


def _namespace(recording: _Recording) -> str:
    """The one namespace whose loop is recorded, as in ``/robot1``; ``/`` for none."""
    found = {_prefix(source) for source in recording.sources if _loop_topic(source)}
    given = recording.info.get("namespace")
    if given is not None:
        found = {given.strip("/")}
    if len(found) > 1:
        names = ", ".join(f"/{name}" for name in sorted(found))
        raise BadInput(f"{recording.path} holds the loops of {names}: record one namespace a bag")
    return f"/{found.pop()}" if found else "/"


def _malformed(path: Path, source: Source, stamp: int) -> BadInput:
    return BadInput(
        f"{path}: the message on {source.topic} at {stamp / SECOND:g} s is not a {source.type} "
        "of the loop: one number a name"
    )


def _on_disk(path: Path) -> list[Path]:
    return [file for file in path.iterdir() if file.is_file()] if path.is_dir() else [path]
