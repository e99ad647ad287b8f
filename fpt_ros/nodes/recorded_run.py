"""What the recorder is told of the run: by its parameters, its command line, and who started it."""

import os
import sys
from datetime import datetime
from functools import reduce
from pathlib import Path
from typing import NamedTuple

from fpt_ros.experiments.experiment import BASE, complete
from fpt_ros.experiments.parameter_file import ParameterFile, read
from fpt_ros.parameters import Value, Values, word


class RecordedRun(NamedTuple):
    """Of which experiment and variant, where to, and the parameters of all nodes by node."""

    experiment: str
    variant: str
    directory: Path
    parameters: dict[str, dict[str, Value]]


def recorded_run(values: Values) -> RecordedRun:
    """From the recorder's parameters; where these are silent, from the names of the files."""
    files = parameter_files()
    overlays = [path.stem.partition(".")[2] for path in files if "." in path.stem]
    experiment = word(values, "experiment") or (files[0].stem if files else "run")
    variant = word(values, "variant") or (overlays[-1] if overlays else BASE)
    directory = word(values, "directory") or (
        f"{experiment}_{variant}_{datetime.now():%Y-%m-%d_%H-%M-%S}"
    )
    whole = reduce(ParameterFile.overlay, map(read, files), ParameterFile())
    return RecordedRun(experiment, variant, Path(directory), {**complete(whole)})


def parameter_files() -> list[Path]:
    """The parameter files of the command line: they hold the sections of all nodes."""
    pairs = zip(sys.argv, sys.argv[1:], strict=False)
    return [Path(path) for flag, path in pairs if flag == "--params-file"]


def last_change(directory: Path) -> int:
    """When something was written last to a recording that a killed process has left [ns]."""
    try:
        return max((path.stat().st_mtime_ns for path in directory.iterdir()), default=1)
    except OSError:
        return 0  # it did not come to that


def reason_to_end() -> str:
    """What the process that started the graph says about its end."""
    descriptor = os.environ.get("FPT_REASON_FD")
    if not descriptor:
        return ""
    try:
        return os.read(int(descriptor), 65536).decode()
    except OSError:
        return ""
