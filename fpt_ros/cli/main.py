"""The command line: errors in one line; status 2 bad input, 1 a failed run, 130 Ctrl-C."""

import gc
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
from fpt_ros.errors import FptError

INTERRUPTED = 130

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


def main() -> None:
    """Console script."""
    gc.set_threshold(100_000)  # a start makes many objects and no garbage: 0.2 s of it
    status = _main(sys.argv[1:])
    gc.freeze()  # else Python looks through all that NumPy, SciPy and numba hold to end: 0.4 s
    sys.exit(status)


def _main(arguments: list[str]) -> int:
    command = typer.main.get_command(app)
    try:
        status: Any = command.main(args=arguments, prog_name="fpt", standalone_mode=False)
    except FptError as error:
        return _complain(str(error), error.exit_status)
    except (KeyboardInterrupt, typer.Abort):
        return _complain("interrupted", INTERRUPTED)
    except BrokenPipeError:  # the reader of our output has gone, as with `| head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except Exception as error:
        if _was_interrupted(error):
            return _complain("interrupted", INTERRUPTED)
        remedy = extras.remedy(error)
        if remedy:
            return _complain(remedy, 2)
        usage = getattr(error, "format_message", None)  # click's usage errors
        if usage is None:
            raise
        context = getattr(error, "ctx", None)
        help_command = f"{context.command_path if context is not None else 'fpt'} --help"
        return _complain(f"{usage()} ({help_command} shows what is valid)", 2)
    if status == INTERRUPTED:
        return _complain("interrupted", INTERRUPTED)
    return status if isinstance(status, int) else 0


def _was_interrupted(error: BaseException | None) -> bool:
    """Whether a Ctrl-C is behind it: compiled code and libraries may wrap the exception."""
    while error is not None:
        if isinstance(error, KeyboardInterrupt):
            return True
        error = error.__cause__ or error.__context__
    return False


def _complain(message: str, status: int) -> int:
    print(f"fpt: {message}", file=sys.stderr)
    return status


if __name__ == "__main__":
    main()
