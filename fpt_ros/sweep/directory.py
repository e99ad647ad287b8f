"""The directory of many runs: begun anew, or that of the same ones, which go on."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

from fpt_ros.errors import BadInput
from fpt_ros.yaml_text import parse

DEFINITION = "sweep.yaml"


def open_directory(
    definition: Mapping[str, Any], directory: Path, name: str = DEFINITION, kind: str = "sweep"
) -> bool:
    """Make the directory ready; whether there was something to go on with.

    Args:
        definition: what is stored, and has to be the same to go on.
        directory: made where it does not exist.
        name: of the file of the definition.
        kind: what messages call it.

    Raises:
        BadInput: it cannot be written, or is that of something else.
    """
    path = directory / name
    if directory.exists() and not directory.is_dir():
        raise BadInput(f"--out {directory} is a file, it takes a directory")
    if path.exists():
        _compare(definition, path, kind)
        if not os.access(directory, os.W_OK):
            raise BadInput(f"--out {directory} cannot be written: Permission denied")
        return True
    if directory.exists() and any(directory.iterdir()):
        raise BadInput(f"--out {directory} holds other files, give a new directory")
    try:
        directory.mkdir(parents=True, exist_ok=True)
        half = directory / f".{name}"
        with half.open("w", encoding="utf-8") as stream:
            yaml = YAML()
            yaml.width = 4096
            yaml.dump(dict(definition), stream)
        half.replace(path)
    except OSError as error:
        raise BadInput(f"--out {directory} cannot be written: {error.strerror}") from error
    return False


def _compare(definition: Mapping[str, Any], path: Path, kind: str) -> None:
    try:
        stored = parse(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, YAMLError) as error:
        raise BadInput(f"{path} cannot be read, give a new directory") from error
    if not isinstance(stored, dict):
        raise BadInput(f"{path} is not of a {kind}, give a new directory")
    for key in {**definition, **stored}:
        if stored.get(key) != definition.get(key):
            raise BadInput(
                f"{path.parent} is of another {kind}: its {key} is {stored.get(key)}, not "
                f"{definition.get(key)}; give a new directory"
            )
