"""The files that ``fpt denoise`` writes: where they go, and that each is whole."""

import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fpt_ros.analysis.estimates import Estimate
    from fpt_ros.analysis.signal_source import Source

PICTURES = (".png", ".svg", ".pdf")


def targets(
    file: Path, out: Path | None, plot: Path | None, compare: bool, json: bool
) -> tuple[Path, Path | None]:
    """Where table and picture go.

    Raises:
        BadInput: to files that cannot be.
    """
    from fpt_ros.denoising.noisy import PREFIX, parse
    from fpt_ros.errors import BadInput
    from fpt_ros.tables.opening import SUFFIXES
    from fpt_ros.tables.writing import check_target

    if plot is not None and plot.suffix not in PICTURES:
        raise BadInput(f"--plot {plot}: it takes a name that ends in {', '.join(PICTURES)}")
    if str(file) == "-" and out is None:
        target = Path("-")
    elif str(file).startswith(PREFIX):
        target = out or Path(f"{parse(str(file)).signal}-denoised.csv")
    else:
        packed = file.suffix.lower() in SUFFIXES
        plain = file.with_suffix("") if packed else file
        target = out or file.with_name(f"{plain.stem}-denoised.csv")
    check_target("--out", target)
    if str(target) == "-" and json and not compare:
        raise BadInput("--json and the table cannot both go to standard output: give --out FILE")
    for option, path in (("--out", target), ("--plot", plot)):
        if path is None or str(path) == "-":
            continue
        if path.absolute() == file.absolute():
            raise BadInput(f"{option} {path} is the input: give another name")
        if not path.absolute().parent.is_dir():
            raise BadInput(f"{option} {path}: the folder {path.parent} does not exist: make it")
    return target, plot


def picture_path(plot: Path, one: "Estimate", count: int) -> Path:
    """The picture's file: with the signal's name in it where there are several."""
    if count == 1:
        return plot
    name = re.sub(r"[^\w.-]+", "_", one.signal.name).strip("_")
    return plot.with_name(f"{plot.stem}-{name}{plot.suffix}")


def write(source: "Source", found: "list[Estimate]", target: Path, pictures: list[Path]) -> None:
    """Table and pictures; each appears whole or not at all."""
    from fpt_ros.analysis.estimates import columns_with
    from fpt_ros.analysis.whole_files import write_whole
    from fpt_ros.errors import BadInput
    from fpt_ros.tables.writing import encoded

    path = target
    try:
        chunks = encoded(columns_with(source, found), target)
        if str(target) == "-":
            sys.stdout.buffer.writelines(chunks)
            sys.stdout.buffer.flush()
        else:
            write_whole(target, chunks)
        for path, one in zip(pictures, found, strict=False):  # none where none was asked for
            from fpt_ros.analysis.signal_figure import picture

            write_whole(path, picture(source, one, path.suffix[1:]))
    except BrokenPipeError:
        raise
    except OSError as error:
        raise BadInput(f"{error.filename or path} cannot be written: {error.strerror}") from error
