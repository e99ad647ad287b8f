"""``fpt simulate``."""

import signal
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from time import perf_counter

from fpt_ros.cli.gain import warn_about_gain
from fpt_ros.cli.options import (
    Duration,
    Json,
    Name,
    Record,
    Seed,
    Settings,
    Variant,
    check_new_directory,
    experiment_of,
)


def simulate(
    name: Name,
    variant: Variant = "adaptive",
    set_: Settings = None,
    duration: Duration = None,
    seed: Seed = None,
    record: Record = None,
    json: Json = False,
) -> None:
    """Run an experiment in process, without ROS: the same numbers as fpt run, much faster.

    Example: fpt simulate tora --variant strong --set fpt_deformer.A=-2 --record /tmp/tora
    """
    experiment = experiment_of(name, variant, set_, duration, seed)
    if record is not None:
        check_new_directory(record)
    warn_about_gain(experiment)
    from fpt_ros.analysis.metrics import Metrics
    from fpt_ros.bags.recording import EngineRecording
    from fpt_ros.cli.output import print_result, progress_bar
    from fpt_ros.engine.engine import Engine
    from fpt_ros.errors import Interrupted, RunFailed
    from fpt_ros.runs.chunks import Consumer
    from fpt_ros.runs.run import describe

    failure: RunFailed | Interrupted | None = None
    started = perf_counter()
    loop = experiment.loop()
    metrics = Metrics(experiment.nodes)
    consumers: list[Consumer] = [metrics]
    title = f"{experiment.name} {experiment.variant}"
    with ExitStack() as stack:
        interrupted = stack.enter_context(interrupts())
        recording = None
        if record is not None:
            recording = stack.enter_context(EngineRecording(record, experiment))
            consumers.append(recording)
        bar = stack.enter_context(progress_bar(title, loop.plant.cycles))
        engine = Engine(loop, consumers=consumers)

        def progress(cycle: int) -> None:
            bar(cycle)
            if interrupted:
                raise Interrupted(f"interrupted in cycle {cycle}")

        prepared = perf_counter()
        try:
            engine.run(progress)
        except (RunFailed, Interrupted) as error:
            failure = error
            if recording is not None:
                recording.reason = str(error)
    ended = perf_counter()
    result = metrics.result(describe(experiment, "in_process", str(failure or "")))
    cycles = result["cycles"]
    assert isinstance(cycles, int)
    print_result(
        {
            **result,
            "wall_time": ended - started,  # with loading and, the first time, compiling
            "cycles_per_second": cycles / (ended - prepared),
            "bag": str(record) if record is not None else None,
        },
        json,
    )
    if failure is not None:
        raise failure


@contextmanager
def interrupts() -> Iterator[list[int]]:
    """Collect Ctrl-C instead of raising it anywhere: the engine ends between two cycles."""
    seen: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, frame: seen.append(number))
    try:
        yield seen
    finally:
        signal.signal(signal.SIGINT, before)
