"""All commands, and how they end: errors in one line, with their exit status."""

import os
import sys
from collections.abc import Callable
from functools import wraps
from typing import Any

import typer

from fpt_ros import extras
from fpt_ros.cli import (
    compare,
    control,
    demo,
    denoise,
    diagram,
    diff,
    doctor,
    export,
    gain,
    info,
    layout,
    listing,
    params,
    recover,
    replay,
    report,
    reproduce,
    rerun,
    robot,
    robustness,
    run,
    simulate,
    soak,
    sweep,
    tune,
    watch,
)
from fpt_ros.cli.interrupts import INTERRUPTED, complain
from fpt_ros.errors import FptError

app = typer.Typer(
    name="fpt",
    help="Adaptive control by Fixed Point Transformations: run it, record it, look at it.",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)


COMMANDS: tuple[tuple[str, Callable[..., Any], str], ...] = (
    ("list", listing.list_experiments, ""),
    ("simulate", simulate.simulate, ""),
    ("sweep", sweep.sweep, "sweep"),
    ("tune", tune.tune, "sweep"),
    ("compare", compare.compare, "compare"),
    ("run", run.run, ""),
    ("report", report.report, "analysis"),
    ("gain", gain.gain, ""),
    ("robot", robot.robot, "robots"),
    ("diagram", diagram.diagram, ""),
    ("robustness", robustness.robustness, "sweep"),
    ("denoise", denoise.denoise, "denoise"),
    ("info", info.info, ""),
    ("recover", recover.recover, ""),
    ("diff", diff.diff, ""),
    ("replay", replay.replay, ""),
    ("rerun", rerun.rerun, ""),
    ("export", export.export, "export"),
    ("layout", layout.layout, ""),
    ("doctor", doctor.doctor, ""),
    ("soak", soak.soak, ""),
    ("pause", control.pause, ""),
    ("resume", control.resume, ""),
    ("step", control.step, ""),
    ("reset", control.reset, ""),
    ("stop", control.stop, ""),
    ("e-stop", control.e_stop, ""),
    ("reproduce", reproduce.reproduce, "thesis"),
    ("demo", demo.demo, "analysis"),
    ("watch", watch.watch, "analysis"),
)
"""Name, function, and the extra of the installation without which it cannot work."""


def _checked(function: Callable[..., Any], extra: str) -> Callable[..., Any]:
    """The same command, which ends before it begins if its extra is not installed."""

    @wraps(function)
    def command(*arguments: Any, **options: Any) -> Any:
        if extra:
            extras.need(extra)
        return function(*arguments, **options)

    return command


for _name, _function, _extra in COMMANDS:
    app.command(_name, help=_function.__doc__)(_checked(_function, _extra))


app.add_typer(params.app, name="params")


@app.callback(invoke_without_command=True)
def _root(version: bool = typer.Option(False, "--version", help="Print the version.")) -> None:
    if version:
        from fpt_ros import __version__

        print(__version__)
        raise typer.Exit


def run_command(arguments: list[str]) -> int:
    """Run a command; its exit status."""
    command = typer.main.get_command(app)
    try:
        status: Any = command.main(args=arguments, prog_name="fpt", standalone_mode=False)
    except FptError as error:
        return complain(str(error), error.exit_status)
    except (KeyboardInterrupt, typer.Abort):
        return complain("interrupted", INTERRUPTED)
    except BrokenPipeError:  # the reader of our output has gone, as with `| head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except Exception as error:
        if _was_interrupted(error):
            return complain("interrupted", INTERRUPTED)
        remedy = extras.remedy(error)
        if remedy:
            return complain(remedy, 2)
        usage = getattr(error, "format_message", None)  # click's usage errors
        if usage is None:
            raise
        context = getattr(error, "ctx", None)
        help_command = f"{context.command_path if context is not None else 'fpt'} --help"
        return complain(f"{usage()} ({help_command} shows what is valid)", 2)
    if status == INTERRUPTED:
        return complain("interrupted", INTERRUPTED)
    return status if isinstance(status, int) else 0


def _was_interrupted(error: BaseException | None) -> bool:
    """Whether a Ctrl-C is behind it: compiled code and libraries may wrap the exception."""
    while error is not None:
        if isinstance(error, KeyboardInterrupt):
            return True
        error = error.__cause__ or error.__context__
    return False
