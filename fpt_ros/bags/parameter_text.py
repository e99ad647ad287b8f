"""The parameters of all nodes as the text of a parameter file, and back."""

from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

from fpt_ros.errors import BadInput
from fpt_ros.experiments import parameter_file
from fpt_ros.parameters import Value, Values

NAME = "parameters.yaml"


def to_text(nodes: Mapping[str, Values]) -> str:
    """A ROS 2 parameter file for these nodes, which ``--params-file`` takes."""
    # the reader and writer of parameter files take paths
    with TemporaryDirectory(prefix="fpt_ros.") as folder:
        path = Path(folder, NAME)
        parameter_file.write(path, nodes)
        return path.read_text(encoding="utf-8")


def from_text(text: bytes, where: str) -> dict[str, dict[str, Value]]:
    """Parameters by node of a parameter file's text.

    Raises:
        BadInput: not a parameter file; ``where`` names its origin.
    """
    with TemporaryDirectory(prefix="fpt_ros.") as folder:
        path = Path(folder, NAME)
        path.write_bytes(text)
        try:
            return parameter_file.read(path).nodes
        except BadInput as error:
            raise BadInput(str(error).replace(str(path), f"{where}: its {NAME}")) from error
