"""A change of parameters in flight, and when it took effect."""

from collections.abc import Mapping
from dataclasses import dataclass

from fpt_ros.parameters import Value


@dataclass(frozen=True)
class Change:
    """One accepted change.

    Attributes:
        node: its name, without a namespace.
        stamp: of the first cycle in which it was in force [ns].
        values: that changed.
    """

    node: str
    stamp: int
    values: Mapping[str, Value]
