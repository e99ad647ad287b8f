"""``fpt simulate``."""

from contextlib import ExitStack
from time import perf_counter

from fpt_ros.cli.gain import warn_about_gain
from fpt_ros.cli.interrupts import at_once, collected
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
    with at_once():
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

        started = perf_counter()
        loop = experiment.loop()
    failure: RunFailed | Interrupted | None = None
    metrics = Metrics(experiment.nodes)
    consumers: list[Consumer] = [metrics]
    title = f"{experiment.name} {experiment.variant}"
    with ExitStack() as stack:
        recording = None
        if record is not None:
            recording = stack.enter_context(EngineRecording(record, experiment))
            consumers.append(recording)
        bar = stack.enter_context(progress_bar(title, loop.plant.cycles))

        def give_up() -> None:
            if recording is not None:
                recording.reason = "interrupted in cycle 0"
            stack.close()

        with at_once(give_up):
            engine = Engine(loop, consumers=consumers)
        interrupted = stack.enter_context(collected())

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
