"""Records: what a stage works on, as named vectors over one buffer.

A stage declares its constants, its memory (the state) and its work space as ``NamedTuple`` classes.
A :class:`Layout` says where the vectors of a memory lie on one buffer of doubles: the stage's own
state, an array of the engine, or a file mapped into memory. Machine code takes the same records;
its types are derived from the annotations (:mod:`fpt_ros.engine.types`).

Example::

    class Memory(NamedTuple):
        turns: MutableVector
        ring: Matrix

    layout = Layout(Memory, turns=1, ring=(3, 2))
    memory = layout.on(array("d", bytes(8 * layout.size)))
    memory.ring[2, 0] = 1.0
"""

from array import array
from math import prod
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar, Union, cast

from fpt_ros.laws import Matrix, MutableVector

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

Record = TypeVar("Record", bound=tuple[Any, ...])

Buffer = Union["array[float]", "memoryview[float]", "Array"]
"""Doubles in one piece."""


class ByRow(NamedTuple):
    """Size of a matrix that is read row by row only, ``m[row]``, each a vector for a law."""

    rows: int
    columns: int


Size = int | tuple[int, int] | ByRow
"""Length of a vector, or rows and columns of a matrix."""


class Layout(Generic[Record]):
    """Where the vectors of a record lie on a buffer, one after the other in the record's order.

    Attributes:
        size: numbers of the whole.
    """

    def __init__(self, record: type[Record], **sizes: Size) -> None:
        """Give a size to each field of the record."""
        self._record = record
        fields: tuple[str, ...] = record._fields  # type: ignore[attr-defined]
        if set(sizes) != set(fields):
            raise TypeError(f"{record.__name__} has the fields {', '.join(fields)}")
        self._shapes = [sizes[name] for name in fields]
        self.size = sum(map(_count, self._shapes))

    def new(self) -> "array[float]":
        """A buffer of zeros."""
        return array("d", bytes(8 * self.size))

    def on(self, buffer: Buffer) -> Record:
        """The record on a buffer of doubles (array, memoryview, NumPy array): views, no copies.

        Raises:
            ValueError: the buffer holds another count of numbers.
        """
        if len(buffer) != self.size:
            raise ValueError(f"{self.size} numbers needed, the buffer holds {len(buffer)}")
        whole: memoryview[float] | Array = (
            cast("memoryview[float]", memoryview(buffer)) if isinstance(buffer, array) else buffer
        )
        views: list[Any] = []
        at = 0
        for shape in self._shapes:
            end = at + _count(shape)
            views.append(_view(whole[at:end], shape))
            at = end
        return self._record(*views)


def _count(shape: Size) -> int:
    return shape if isinstance(shape, int) else prod(shape)


def _view(flat: "memoryview[float] | Array", shape: Size) -> MutableVector | Matrix:
    if not isinstance(flat, memoryview):
        return cast(Matrix, flat.reshape(shape))
    if isinstance(shape, int):
        return cast(MutableVector, flat)
    if isinstance(shape, ByRow):  # a memoryview of two dimensions has no rows
        n = shape.columns
        return cast(Matrix, tuple(flat[i * n : (i + 1) * n] for i in range(shape.rows)))
    if not len(flat):
        return cast(Matrix, ())  # a memoryview cannot be without rows
    return cast(Matrix, flat.cast("B").cast("d", shape=shape))
