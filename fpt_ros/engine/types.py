"""The types of machine code, derived from the annotations of laws and records."""

from collections.abc import Callable
from functools import cache
from typing import Any, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

from fpt_ros.laws import Indices, Matrix, MutableVector, Vector

Array = NDArray[np.float64]


@cache
def type_of(annotation: Any) -> Any:
    """Numba's type of what is annotated so: a number, a vector, a record, or a law.

    Raises:
        TypeError: it is none of these.
    """
    from numba import types as numba_types

    types: Any = numba_types

    plain = {
        None: types.void,
        type(None): types.void,
        float: types.float64,
        int: types.int64,
        Vector: types.float64[::1],
        MutableVector: types.float64[::1],
        Indices: types.int64[::1],
        Matrix: types.float64[:, ::1],
    }
    if annotation in plain:
        return plain[annotation]
    if get_origin(annotation) is get_origin(Callable[[], None]):
        return types.FunctionType(signature_of(annotation))
    if isinstance(annotation, type) and hasattr(annotation, "_fields"):
        kinds = [type_of(kind) for kind in _fields(annotation)]
        if len(set(kinds)) == 1 and kinds:  # as numba.typeof decides
            return types.NamedUniTuple(kinds[0], len(kinds), annotation)
        return types.NamedTuple(kinds, annotation)
    raise TypeError(f"{annotation} has no machine type: laws take numbers, vectors and records")


def signature_of(law: Any) -> Any:
    """Numba's signature of a law's kind, which is a ``Callable[[...], ...]``."""
    arguments, result = get_args(law)
    return type_of(result)(*map(type_of, arguments))


def arguments_of(function: Callable[..., Any]) -> tuple[dict[str, Any], dict[str, Any], Any]:
    """The annotations of a loop: of its laws, of its other arguments, and of its result."""
    hints = get_type_hints(function)
    result = hints.pop("return")
    laws = {name: hint for name, hint in hints.items() if get_args(hint) and _is_law(hint)}
    rest = {name: hint for name, hint in hints.items() if name not in laws}
    return laws, rest, result


def _is_law(hint: Any) -> bool:
    return get_origin(hint) is get_origin(Callable[[], None])


def as_arrays(record: Any, kind: Any) -> Any:
    """A record of lists as machine code takes it: vectors become arrays (new ones)."""
    if kind in (Vector, MutableVector):
        return np.array(record, dtype=np.float64)
    if kind == Indices:
        return np.array(record, dtype=np.int64)
    if kind == Matrix:
        rows = np.array([list(row) for row in record], dtype=np.float64)
        return rows if rows.ndim == 2 else np.empty((0, 0))
    if kind in (float, int):
        return kind(record)
    return kind(*[as_arrays(each, hint) for each, hint in zip(record, _fields(kind), strict=True)])


def empty(kind: Any) -> Any:
    """A record without numbers, for a stage that is not in the loop."""
    if kind in (Vector, MutableVector):
        return np.empty(0)
    if kind == Indices:
        return np.empty(0, dtype=np.int64)
    if kind == Matrix:
        return np.empty((0, 0))
    if kind in (float, int):
        return kind(0)
    return kind(*map(empty, _fields(kind)))


@cache
def _fields(record: Any) -> tuple[Any, ...]:
    """The annotations of a record's fields."""
    return tuple(get_type_hints(record).values())
