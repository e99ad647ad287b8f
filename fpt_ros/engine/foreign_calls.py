"""The calls of :mod:`fpt_ros.foreign` as machine code: a jump to an address found at run time.

The address is a number among a law's constants, so the machine code is the same in every process
and is kept on disk.
"""

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from fpt_ros import foreign


@cache
def register() -> None:
    """Make the calls known to numba; once a process."""
    import numba.extending
    from numba import types as numba_types

    from fpt_ros.engine.compiled import OPTIONS

    overload: Any = numba.extending.overload
    types: Any = numba_types
    for function, result in (
        (foreign.call, types.none),
        (foreign.call_double, types.float64),
        (foreign.call_int, types.int64),
    ):
        overload(function, jit_options=OPTIONS)(_calling(_invoke(result)))
    make = _make_pointer()

    def pointer(address: Any) -> Callable[..., Any]:
        def called(address: Any) -> Any:  # numba compares the annotations, too
            return make(address)

        return called

    overload(foreign.pointer, jit_options=OPTIONS)(pointer)


def _calling(invoke: Any) -> Callable[..., Any]:
    def typed(address: Any, *arguments: Any) -> Callable[..., Any]:
        def called(address: Any, *arguments: Any) -> Any:
            return invoke(address, arguments)

        return called

    return typed


def _make_pointer() -> Any:
    """An intrinsic: a number as ``void *``."""
    import numba.extending
    from numba import types as numba_types

    types: Any = numba_types

    def make(context: Any, address: Any) -> Any:
        def code(target: Any, builder: Any, signature: Any, values: Any) -> Any:
            number = _as_integer(builder, signature.args[0], values[0])
            return builder.inttoptr(number, target.get_value_type(types.voidptr))

        return types.voidptr(address), code

    intrinsic: Any = numba.extending.intrinsic
    return intrinsic(make)


def _as_integer(builder: Any, kind: Any, value: Any) -> Any:
    """A number as 64 bits."""
    from llvmlite import ir
    from numba import types as numba_types

    types: Any = numba_types
    bits = ir.IntType(64)
    if isinstance(kind, types.Float):
        return builder.fptoui(value, bits)
    if value.type.width == 64:
        return value
    signed = isinstance(kind, types.Integer) and kind.signed
    return builder.sext(value, bits) if signed else builder.zext(value, bits)


def _invoke(result: Any) -> Any:
    """An intrinsic: call what is at an address, with the values of a tuple."""
    import numba.extending
    from llvmlite import ir
    from numba import types as numba_types
    from numba.core.errors import TypingError

    types: Any = numba_types
    doubles, bits = ir.DoubleType(), ir.IntType(64)
    returned: Mapping[Any, Any] = {
        types.none: ir.VoidType(),
        types.float64: doubles,
        types.int64: ir.IntType(32),
    }

    def passed(target: Any, builder: Any, kind: Any, value: Any) -> Any:
        if isinstance(kind, types.Array):
            return target.make_array(kind)(target, builder, value).data
        if isinstance(kind, types.Float):
            return value if value.type == doubles else builder.fpext(value, doubles)
        return value if kind == types.voidptr else _as_integer(builder, kind, value)

    def invoke(context: Any, address: Any, arguments: Any) -> Any:
        for kind in arguments:
            vector = isinstance(kind, types.Array) and kind.dtype == types.float64
            number = isinstance(kind, types.Float | types.Integer | types.Boolean)
            if not (number or kind == types.voidptr or (vector and kind.layout == "C")):
                raise TypingError(f"C takes numbers, vectors and pointers, not {kind}")

        def code(target: Any, builder: Any, signature: Any, values: Any) -> Any:
            number = _as_integer(builder, signature.args[0], values[0])
            given = [
                passed(target, builder, kind, builder.extract_value(values[1], i))
                for i, kind in enumerate(signature.args[1])
            ]
            kinds = [each.type for each in given]
            function = ir.FunctionType(returned[result], kinds).as_pointer()
            answer = builder.call(builder.inttoptr(number, function), given)
            if result == types.none:
                return target.get_dummy_value()
            return builder.sext(answer, bits) if result == types.int64 else answer

        return result(address, arguments), code

    intrinsic: Any = numba.extending.intrinsic
    return intrinsic(invoke)
