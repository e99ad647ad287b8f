"""``fpt tune``."""

import shlex
import sys
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fpt_ros.cli.options import Duration, Json, Name, Settings, Variant

if TYPE_CHECKING:
    from fpt_ros.sweep.tune import Result, Task

Metrics = Annotated[
    list[str] | None,
    typer.Option(
        "--metric", metavar="NAME", help="What shall be small; repeatable; default: rms_settled."
    ),
]
Over = Annotated[
    list[str] | None,
    typer.Option(
        metavar="NODE.PARAM[=LOW:HIGH],...",
        help="What is tuned; without a range from a tenth of the present value to ten times it.",
    ),
]
Limit = Annotated[
    list[str] | None,
    typer.Option(metavar="METRIC=VALUE,...", help="What must not be exceeded, as chatter=0.02."),
]
Trials = Annotated[int, typer.Option(metavar="N", help="Number of runs.")]
Seed = Annotated[int, typer.Option(metavar="S", help="Random seed of the search.")]
Out = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="The overlay; default: NAME.tuned.yaml here, or beside a NAME of yours.",
    ),
]


def tune(
    name: Name,
    variant: Variant = "adaptive",
    set_: Settings = None,
    duration: Duration = None,
    metric: Metrics = None,
    over: Over = None,
    limit: Limit = None,
    trials: Trials = 200,
    seed: Seed = 0,
    out: Out = None,
    json: Json = False,
) -> None:
    """Find good parameters under limits on effort and chatter; write them as an overlay file.

    The file is used with --variant FILE.yaml, which the last line of the output spells out.

    Example: fpt tune tora --over fpt_deformer.A,trajectory_generator.lambda --limit chatter=0.02
    """
    from fpt_ros.cli.interrupts import collected
    from fpt_ros.errors import BadInput, Interrupted
    from fpt_ros.sweep import tune as tuning
    from fpt_ros.sweep.executor import keep_memory
    from fpt_ros.sweep.overlay import check_overlay, write_overlay

    if trials < 1:
        raise BadInput(f"--trials {trials} is not valid, it takes 1 or more")
    if not 0 <= seed < 2**32:
        raise BadInput(f"--seed {seed} is not valid, it takes 0 to {2**32 - 1}")
    task = tuning.define(
        name, variant, set_ or (), duration, over or (), metric or ("rms_settled",), limit or ()
    )
    path = out or _default_out(name)
    check_overlay(path)
    keep_memory()
    started = perf_counter()
    with collected() as interrupted, _progress(f"tuning {name}", trials) as bar:

        def look(done: int, best: float) -> None:
            bar(done)
            if interrupted:
                raise Interrupted(f"interrupted after {done} of {trials} runs, nothing is written")

        found = tuning.search(task, trials, seed, look)
    write_overlay(task, found, path)
    result = {
        **_result(task, found),
        "wall_time": perf_counter() - started,
        "overlay": str(path),
        "use": shlex.join(["fpt", "simulate", name, "--variant", str(path)]),
    }
    if json:
        from fpt_ros.cli.output import print_json

        print_json(result)
        return
    _print(result)


def _default_out(name: str) -> Path:
    from fpt_ros.experiments.experiment import is_path

    given = Path(name)
    return (
        given.with_name(f"{given.stem}.tuned.yaml") if is_path(name) else Path(f"{name}.tuned.yaml")
    )


def _result(task: "Task", found: "Result") -> dict[str, Any]:
    from fpt_ros.sweep.metric import metric

    shown = list(dict.fromkeys([*task.metrics, *task.limits, "chatter"]))
    return {
        "experiment": found.experiment.name,
        "variant": found.experiment.variant,
        "trials": found.trials,
        "parameters": {
            name: {"before": found.present[name], "after": value}
            for name, value in found.found.items()
        },
        "metrics": {
            name: {
                "before": metric(found.before, name),
                "after": metric(found.after, name),
                "limit": task.limits.get(name),
            }
            for name in shown
        },
    }


def _print(result: dict[str, Any]) -> None:
    from rich.table import Table

    from fpt_ros.cli.output import console

    table = Table("", "before", "after", "limit", box=None, pad_edge=False)
    for what, row in {**result["parameters"], **result["metrics"]}.items():
        numbers = (row["before"], row["after"], row.get("limit"))
        table.add_row(what, *("" if each is None else f"{each:.6g}" for each in numbers))
    console().print(table)
    print(f"{result['trials']} runs in {result['wall_time']:.1f} s")
    print(f"overlay: {result['overlay']}")
    print(f"run it:  {result['use']}")


def _progress(what: str, total: int) -> Any:
    """A bar on standard error with the time left; on a pipe its first line only."""
    from contextlib import contextmanager

    @contextmanager
    def made() -> Any:
        if not sys.stderr.isatty():
            print(f"{what}: {total} runs", file=sys.stderr)
            yield lambda done: None
            return
        from rich.console import Console
        from rich.progress import Progress

        with Progress(console=Console(stderr=True), transient=True) as bar:
            task = bar.add_task(what, total=total)
            yield lambda done: bar.update(task, completed=done)

    return made()
