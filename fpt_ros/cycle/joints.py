"""Joints by name: the entrance of every stage.

A message may name its joints in any order, and more joints than are wanted; vectors that a sender
leaves empty (``velocity`` of a JointState) are not known: NaN. Behind the entrance all vectors are
over the joints of the stage, in the stage's own order.
"""

import math
from typing import Any, TypeVar

from fpt_ros.errors import BadInput
from fpt_ros.laws import Indices, Vector
from fpt_ros.messages.frames import Frame, Names

Taken = TypeVar("Taken", bound=Frame)


class Entrance:
    """Puts the vectors of the frames of one topic into an order of joints.

    Args:
        who: names node and topic in messages.
        names: the joints wanted, in their order; empty: those of the first frame.
        partial: whether joints may be absent (NaN then), as in ``desired`` with time sharing.
    """

    def __init__(self, who: str, names: Names, partial: bool = False) -> None:
        self.names = names
        self._who = who
        self._partial = partial
        self._seen: Names | None = None
        self._good: Names | None = None
        self._places: tuple[int, ...] | None = None  # None: as they come

    def take(self, frame: Taken) -> Taken:
        """The frame over the wanted joints.

        Raises:
            BadInput: a wanted joint is absent, one is named twice, or a vector is of another length
                than the names.
        """
        stamp, names = frame[0], frame[1]
        if names is self._good:
            return frame  # a codec gives the same object only for the same layout
        if names is not self._seen:
            self._meet(names)
        if self._places is None and all(len(vector) == len(names) for vector in frame[2:]):
            self._good = names
            return frame
        places = range(len(names)) if self._places is None else self._places
        vectors = [
            self._ordered(field, vector, len(names), places)
            for field, vector in zip(frame._fields[2:], frame[2:], strict=True)
        ]
        make: Any = type(frame)
        taken: Taken = make(stamp, self.names, *vectors)
        return taken

    def _meet(self, names: Names) -> None:
        """Names that are not those of the frame before."""
        if not self.names:
            self.names = names
        twice = {name for name in names if names.count(name) > 1}
        if twice:
            raise BadInput(f"{self._who}: the joint '{min(twice)}' is named twice")
        missing = [name for name in self.names if name not in names]
        if missing and not (self._partial and len(missing) < len(self.names)):
            raise BadInput(
                f"{self._who}: the joint '{missing[0]}' is not there, only "
                f"{', '.join(names) or 'none at all'}"
            )
        places = tuple(names.index(name) if name in names else -1 for name in self.names)
        self._places = None if places == tuple(range(len(names))) else places
        self._seen = names

    def _ordered(self, field: str, vector: Vector, length: int, places: Indices) -> list[float]:
        if not len(vector):
            return [math.nan] * len(self.names)
        if len(vector) != length:
            raise BadInput(f"{self._who}: {field} holds {len(vector)} numbers for {length} joints")
        return [vector[at] if at >= 0 else math.nan for at in places]
