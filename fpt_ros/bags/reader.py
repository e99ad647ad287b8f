"""Reading a recording back as the run that it is a recording of."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from fpt_ros.bags import contents, numbers, parameter_text
from fpt_ros.bags.bag import Bag
from fpt_ros.bags.files import on_disk
from fpt_ros.bags.loop_series import loop_topic, series
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND
from fpt_ros.messages.topics import BY_NAME
from fpt_ros.parameters import Value, Values
from fpt_ros.runs.chunks import CHUNK, Consumer, ordered
from fpt_ros.runs.chunks import rows as rows_of
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
    aside = contents.Aside(bag)
    readings = numbers.read(bag, aside.is_of_the_loop, aside.take)
    parameters = contents.parameters(bag)
    about = contents.ending(bag)
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
    contents.namespace(bag)
    if not topics and not bag.missing:
        loop = ", ".join(BY_NAME)
        raise BadInput(f"{path} holds no messages on the loop's topics: {loop}")
    ending = contents.ending(bag)
    about = contents.told_of_resets({**about, **ending}, aside)
    costs = aside.costs.result()
    return Run(about, parameters, topics, aside.latency, tuple(aside.changes), costs)


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
    aside = contents.Aside(bag)
    for block in bag.blocks():
        aside.take(block)
        for rows in block.rows.values():
            if len(rows):
                low, high = int(rows[:, 0].min()), int(rows[:, 0].max())
                first = low if first is None else min(first, low)
                last = max(last, high)
    ours = parameter_text.NAME in bag.attachments
    parameters = contents.parameters(bag) if ours else {}
    known = contents.told_of_resets(contents.ending(bag), aside)
    about = {key: known.get(key, "") for key in ("experiment", "variant", "engine")}
    rest = {key: value for key, value in known.items() if key not in about}
    return {
        "bag": str(path),
        **about,
        **rest,
        "version": known.get("version", ""),
        "namespace": contents.namespace(bag) if ours else known.get("namespace", ""),
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
        "costs": [cost.numbers() for cost in aside.costs.result()],
        "parameters": parameters,
    }
