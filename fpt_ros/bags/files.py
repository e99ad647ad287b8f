"""Which files make up a recording: what metadata.yaml names, or what lies in the folder."""

import re
import stat
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ruamel.yaml.error import YAMLError

from fpt_ros.errors import BadInput
from fpt_ros.yaml_text import parse

METADATA = "metadata.yaml"
SUFFIXES = (".mcap", ".db3", ".mcap.zstd", ".db3.zstd", ".mcap.zst", ".db3.zst")
SIDE = ".open"
"""Ends the name of the side file that holds the messages of a file's open chunk."""

_PART = re.compile(r"_(\d+)$")
_SPLITS = 1000
"""Files of a split recording have lesser numbers; others are dates."""

_TAKES = "it has to be a recording's directory, or its .mcap or .db3 file"


@dataclass
class Files:
    """What a recording is on disk.

    Attributes:
        paths: in order; side files are not among them.
        metadata: content of metadata.yaml; empty where there is none that can be read.
        notes: what a reader should know, and that loses nothing.
        missing: what is not there and should be.
    """

    paths: list[Path]
    metadata: Mapping[str, Any] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)


def find(path: Path) -> Files:
    """The files of a recording.

    Args:
        path: its directory, or one file.

    Raises:
        BadInput: there are none, or those of several recordings.
    """
    try:
        mode = path.stat().st_mode
        if stat.S_ISDIR(mode):
            return _of_folder(path)
    except FileNotFoundError as error:
        raise BadInput(f"{path} does not exist: {_TAKES}") from error
    except OSError as error:
        raise BadInput(f"{path} cannot be read: {error.strerror}") from error
    if not stat.S_ISREG(mode):
        raise BadInput(f"{path} is a pipe or a device: {_TAKES}")
    if path.name == METADATA:
        return _of_folder(path.parent)
    return Files([path])


def on_disk(path: Path) -> int:
    """Bytes of a recording's files, of the whole folder where it is one."""
    found = [path]
    if path.is_dir():
        found = [file for file in path.iterdir() if file.is_file()]
    return sum(file.stat().st_size for file in found)


def _of_folder(folder: Path) -> Files:
    there = sorted(
        (each for each in folder.iterdir() if each.name.endswith(SUFFIXES)),
        key=lambda each: (len(each.name), each.name),  # ..._10.mcap behind ..._9.mcap
    )
    for each in there:
        if not each.is_file():
            raise BadInput(f"{each} cannot be read: it is not a file")
    files = Files(there)
    named = _read_metadata(folder, files)
    if named:
        files.paths = [folder / name for name in named if (folder / name).is_file()]
        lost = [name for name in named if not (folder / name).is_file()]
        files.missing += [f"{name} is named in {METADATA} and is not there" for name in lost]
        files.notes += [
            f"{each.name} is not named in {METADATA} and is left out"
            for each in there
            if each not in files.paths
        ]
    elif files.paths:
        _check_one_recording(folder, files.paths)
        files.missing += [f"{name} is not there" for name in _gaps(folder, files.paths)]
    if not files.paths:
        raise BadInput(f"{folder} holds no .mcap file: {_TAKES}")
    return files


def _read_metadata(folder: Path, files: Files) -> list[str]:
    """Names of the files that metadata.yaml lists."""
    path = folder / METADATA
    try:
        content = parse(path.read_text(encoding="utf-8"))
        about = content["rosbag2_bagfile_information"]
        names = [str(name) for name in about["relative_file_paths"]]
    except FileNotFoundError:
        files.notes.append(f"there is no {METADATA}")
        return []
    except (OSError, ValueError, YAMLError, KeyError, TypeError, RecursionError):
        files.missing.append(f"{METADATA} cannot be read: all files of the folder are taken")
        return []
    files.metadata = about
    # rosbag2 before Galactic wrote the folder's name in front
    return [name if (folder / name).exists() else Path(name).name for name in names]


def _check_one_recording(folder: Path, paths: list[Path]) -> None:
    stems = dict.fromkeys(_PART.sub("", path.name.partition(".")[0]) for path in paths)
    if len(stems) > 1:
        names = ", ".join(path.name for path in paths)
        raise BadInput(
            f"{folder} holds several recordings ({names}) and no {METADATA} that says which: "
            "give one file"
        )


def _gaps(folder: Path, paths: list[Path]) -> list[str]:
    """Names of files that a split recording lacks: they are numbered from 0.

    One file alone may be somebody's copy, but not under the folder's name.
    """
    parts = [path.name.partition(".") for path in paths]
    numbers = [_PART.search(stem) for stem, _, _ in parts]
    found = {int(each[1]) for each in numbers if each is not None}
    stem = _PART.sub("", parts[0][0])
    alone = len(paths) == 1 and stem != folder.absolute().name
    if alone or None in numbers or max(found) >= _SPLITS:
        return []
    lost = sorted(set(range(max(found))) - found)
    return [f"{stem}_{number}.{parts[0][2]}" for number in lost]
