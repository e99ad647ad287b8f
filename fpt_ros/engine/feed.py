"""Running the engine for those who take the cycles chunk by chunk."""

from collections.abc import Callable, Sequence

from fpt_ros.engine.engine import Engine
from fpt_ros.errors import RunFailed
from fpt_ros.runs.chunks import Consumer, rows


def feed(
    engine: Engine, consumers: Sequence[Consumer], progress: Callable[[int], None] | None = None
) -> None:
    """Run to the end; every consumer takes every cycle, those before a failure too.

    Args:
        engine: that has not run yet.
        consumers: each is given the chunks in their order.
        progress: as :meth:`Engine.run`; cycles that it is told of have been taken.

    Raises:
        RunFailed: as :meth:`Engine.run`, or what a consumer raises.
    """
    given = engine.done

    def give() -> None:
        nonlocal given
        first, given = given, engine.done
        if given == first:
            return
        chunk = {name: rows(series, first, given) for name, series in engine.topics().items()}
        for consumer in consumers:
            consumer.take(chunk)

    def told(cycle: int) -> None:
        give()
        if progress is not None:
            progress(cycle)

    try:
        engine.run(told)
    except RunFailed:
        give()
        raise
