"""The command line: errors in one line; status 2 bad input, 1 a failed run, 130 Ctrl-C."""

import os
import sys
from typing import Any

import typer

from fpt_ros.cli import (
    demo,
    denoise,
    diff,
    export,
    gain,
    info,
    listing,
    recover,
    report,
    reproduce,
    run,
    simulate,
    sweep,
    tune,
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
app.command("list", help=listing.list_experiments.__doc__)(listing.list_experiments)
app.command("simulate", help=simulate.simulate.__doc__)(simulate.simulate)
app.command("sweep", help=sweep.sweep.__doc__)(sweep.sweep)
app.command("tune", help=tune.tune.__doc__)(tune.tune)
app.command("run", help=run.run.__doc__)(run.run)
app.command("report", help=report.report.__doc__)(report.report)
app.command("gain", help=gain.gain.__doc__)(gain.gain)
app.command("denoise", help=denoise.denoise.__doc__)(denoise.denoise)
app.command("info", help=info.info.__doc__)(info.info)
app.command("recover", help=recover.recover.__doc__)(recover.recover)
app.command("diff", help=diff.diff.__doc__)(diff.diff)
app.command("export", help=export.export.__doc__)(export.export)
app.command("reproduce", help=reproduce.reproduce.__doc__)(reproduce.reproduce)
app.command("demo", help=demo.demo.__doc__)(demo.demo)


@app.callback(invoke_without_command=True)
def _root(version: bool = typer.Option(False, "--version", help="Print the version.")) -> None:
    if version:
        from fpt_ros import __version__

        print(__version__)
        raise typer.Exit


def main() -> None:
    """Console script."""
    sys.exit(_main(sys.argv[1:]))


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
