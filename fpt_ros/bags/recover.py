"""Writing what is left of a recording again, so that every reader opens it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from fpt_ros.bags.bag import Bag
from fpt_ros.bags.copy import Copy
from fpt_ros.bags.metadata import write_metadata
from fpt_ros.errors import BadInput, RunFailed

SUFFIX = "-recovered"


@dataclass(frozen=True)
class Recovered:
    """What was written.

    Attributes:
        directory: of the new recording.
        counts: messages by topic.
        missing: what the old one does not hold any more.
    """

    directory: Path
    counts: Mapping[str, int]
    missing: tuple[str, ...]


def recover(
    path: Path, directory: Path | None = None, progress: Callable[[int], None] = lambda done: None
) -> Recovered:
    """Write all that is whole in a recording as a new one; the old one stays as it is.

    Args:
        path: a recording, or one file of it.
        directory: of the new one, must not exist; by default NAME-recovered beside the old one.
        progress: is told how many messages are written.

    Raises:
        BadInput: nothing of it can be read, or the directory exists or cannot be created.
        RunFailed: the new one cannot be written.
    """
    bag = Bag(path)
    stem = path.absolute().name.partition(".")[0] or path.absolute().name
    directory = directory or path.absolute().with_name(stem + SUFFIX)
    part = directory.with_name(directory.name + ".part")
    if directory.exists() or part.exists():
        taken = directory if directory.exists() else part
        raise BadInput(f"{taken} exists: --out takes the name of a new directory")
    try:
        part.mkdir(parents=True)
    except OSError as error:
        raise BadInput(f"{directory} cannot be created: {error.strerror}") from error
    name = f"{directory.name}_0.mcap"
    try:
        writer = Copy(bag, part / name)
        written = 0
        for block in bag.blocks():
            writer.begin()
            for source, (stamp, start, end, _) in block.ordered():
                writer.message(source, stamp, bytes(block.data[start:end]))
            written += block.total
            progress(written)
        if not written:
            why = "; ".join(bag.missing) or "it has no messages"
            raise BadInput(f"{path}: there is nothing to recover: {why}")
        custom = writer.finish()
        write_metadata(part, [writer.part(name)], custom)
        part.rename(directory)
    except OSError as error:
        _remove(part)
        raise RunFailed(f"{directory} cannot be written: {error.strerror}") from error
    except BaseException:
        _remove(part)
        raise
    return Recovered(directory, writer.counts(), tuple(bag.missing))


def _remove(directory: Path) -> None:
    for each in directory.iterdir():
        each.unlink()
    directory.rmdir()
