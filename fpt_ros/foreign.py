"""C functions that laws call by address: compiled and in Python with the same bits.

A law finds the address of a function, or of a C object, among its constants: an address of today's
processors is below 2^53 and fits exactly into a double. A :class:`~fpt_ros.plants.Factory` loads
the library and puts the addresses there::

    library = ctypes.CDLL("/usr/lib/libarm.so")

    def coefficients(parameters):
        return address_of(library.arm_response), *parameters

    def response(c, q, v, effort, out):
        call(c[0], c, q, v, effort, out)    # void arm_response(const double *c, ..., double *out)

What is passed: a vector as ``double *``, a float as ``double``, an integer as ``int`` or ``long``
(64 bits are handed over, of which C takes what it declares), :func:`pointer` as ``void *``. C has
to write within the vectors, and to keep what it remembers in a state vector of the law: whatever
else it keeps is lost to replay, and a trial call at load changes it.

Like every function that a law calls these work on tuples, lists, arrays and mapped memory; what is
not made of doubles in memory is copied in, and back where C changed it.
"""

import ctypes
from functools import lru_cache
from typing import Any

from fpt_ros.laws import MutableVector, Vector

Argument = Vector | MutableVector | float


class Pointer(int):
    """An address that C takes as ``void *``."""


def pointer(address: float) -> Pointer:
    """An address among a law's constants, to be passed on as ``void *``: mjModel*, mjData*."""
    return Pointer(address)


def address_of(function: Any) -> float:
    """The address of a function of a :class:`ctypes.CDLL`, for a law's constants."""
    return float(ctypes.cast(function, ctypes.c_void_p).value or 0)


def call(address: float, *arguments: Argument) -> None:
    """Call ``void f(...)``.

    Raises:
        ValueError: there is no address.
        TypeError: an argument is no number, vector or pointer.
    """
    _call(None, address, arguments)


def call_double(address: float, *arguments: Argument) -> float:
    """Call ``double f(...)``; raises as :func:`call`."""
    result: float = _call(ctypes.c_double, address, arguments)
    return result


def call_int(address: float, *arguments: Argument) -> int:
    """Call ``int f(...)``; raises as :func:`call`."""
    result: int = _call(ctypes.c_int, address, arguments)
    return result


@lru_cache(maxsize=256)
def _function(address: int, result: Any, kinds: tuple[Any, ...]) -> Any:
    return ctypes.CFUNCTYPE(result, *kinds)(address)


def _call(result: Any, address: float, arguments: tuple[Any, ...]) -> Any:
    if not 0.0 < address < 2.0**53:
        raise ValueError(f"{address!r} is not the address of a function")
    kinds: list[Any] = []
    values: list[Any] = []
    vectors: dict[int, _Doubles] = {}
    for each in arguments:
        if hasattr(each, "__len__"):
            doubles = vectors.setdefault(id(each), _Doubles(each))
            kinds.append(ctypes.c_void_p)
            values.append(ctypes.addressof(doubles.memory))
        elif isinstance(each, Pointer):
            kinds.append(ctypes.c_void_p)
            values.append(int(each))
        elif isinstance(each, float):
            kinds.append(ctypes.c_double)
            values.append(each)
        elif hasattr(each, "__index__"):
            kinds.append(ctypes.c_int64)
            values.append(each.__index__())
        else:
            raise TypeError(f"C takes numbers, vectors and pointers, not a {type(each).__name__}")
    returned = _function(int(address), result, tuple(kinds))(*values)
    for doubles in vectors.values():
        doubles.give_back()
    return returned


class _Doubles:
    """A vector as doubles in memory: its own where it has them, otherwise a copy."""

    def __init__(self, vector: Any) -> None:
        self._vector = vector
        self._before: bytes | None = None
        try:
            view = memoryview(getattr(vector, "memory", vector))
        except TypeError:
            view = None
        if view is not None and view.format == "d" and view.c_contiguous and not view.readonly:
            self.memory = (ctypes.c_double * (view.nbytes // 8)).from_buffer(view)
        else:
            self.memory = (ctypes.c_double * len(vector))(*vector)
            self._before = bytes(self.memory)

    def give_back(self) -> None:
        """Write into the vector what C changed in the copy.

        Raises:
            TypeError: the vector cannot be written.
        """
        if self._before is None or bytes(self.memory) == self._before:
            return
        for i, value in enumerate(self.memory):
            self._vector[i] = value
