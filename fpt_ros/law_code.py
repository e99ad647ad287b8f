"""What the code of a law refers to, read without running it.

Plain functions that a law calls are compiled with it. What a law must not do is found here:
what has other bits in machine code than in Python (measured on 22,000 numbers: ``x ** 3`` differs
for a quarter of them, ``math.hypot`` for one in 200, ``numpy.tanh`` for a quarter), what depends on
more than the law's arguments, and exceptions, which machine code cannot hand to the loop.
"""

import builtins
import dis
import math
from array import array
from collections.abc import Callable, Iterator
from functools import cache
from inspect import getclosurevars
from types import BuiltinFunctionType, CodeType, FunctionType, ModuleType
from typing import Any, NamedTuple

OTHER_BITS: dict[Any, str] = {
    math.pow: "products, x * x",
    math.hypot: "math.sqrt(x * x + y * y)",
    math.gamma: "a function of your own",
    math.lgamma: "a function of your own",
    builtins.pow: "products, x * x",
    builtins.sum: "a loop that adds",
}
"""Functions whose last bit in machine code is not Python's, and what to write instead."""

OUTSIDE = ("random", "time", "datetime", "os", "io", "socket", "secrets")
"""Modules of what a law does not know: chance, clock, files."""

CONTAINERS = (list, dict, set, bytearray, array)

OWN = "fpt_ros."


class Remark(NamedTuple):
    """Something about a line of a law's file."""

    file: str
    line: int
    text: str


class LawCode(NamedTuple):
    """``functions``: plain ones that it calls, directly or not. ``globals``: what it reads.

    ``mistakes``: what has to be changed; ``warnings``: what only costs time.
    """

    functions: tuple[FunctionType, ...]
    globals: tuple[tuple[str, str], ...]
    mistakes: tuple[Remark, ...]
    warnings: tuple[Remark, ...]


@cache
def read(law: Callable[..., Any]) -> LawCode:
    """Read a law and all plain functions that it calls."""
    reader = _Reader()
    if isinstance(law, FunctionType):
        reader.read(law)
    return LawCode(
        tuple(reader.seen[1:]),
        tuple(sorted(reader.globals)),
        tuple(reader.mistakes),
        tuple(reader.warnings),
    )


def _is_numpy(thing: Any) -> bool:
    module = thing.__name__ if isinstance(thing, ModuleType) else _module_of(thing)
    return module.partition(".")[0] == "numpy"


def _is_number(thing: Any) -> bool:
    return isinstance(thing, int | float)


def _module_of(thing: Any) -> str:
    owner = getattr(thing, "__self__", None)  # of a built-in: its module, or its object
    named = getattr(thing, "__module__", None) or getattr(owner, "__name__", None)
    return str(named or type(thing if owner is None else owner).__module__)


class _Reader:
    def __init__(self) -> None:
        self.seen: list[FunctionType] = []
        self.globals: set[tuple[str, str]] = set()
        self.mistakes: list[Remark] = []
        self.warnings: list[Remark] = []

    def read(self, function: FunctionType) -> None:
        if function in self.seen or function.__module__ == f"{OWN}foreign":
            return
        self.seen.append(function)
        enclosed = getclosurevars(function).nonlocals
        for code in _codes(function.__code__):
            self._read_code(code, function, enclosed)

    def _read_code(self, code: CodeType, function: FunctionType, enclosed: dict[str, Any]) -> None:
        line, module, name = code.co_firstlineno, None, ""
        for instruction in dis.get_instructions(code):
            if instruction.positions is not None and instruction.positions.lineno is not None:
                line = instruction.positions.lineno
            at, operation = (code.co_filename, line), instruction.opname
            if operation in ("LOAD_ATTR", "LOAD_METHOD") and module is not None:
                name = f"{name}.{instruction.argval}"
                module = self._refers(getattr(module, instruction.argval, None), name, at, function)
                continue
            module = None
            if operation in ("LOAD_GLOBAL", "LOAD_DEREF", "LOAD_NAME"):
                name = instruction.argval
                known = enclosed if operation == "LOAD_DEREF" else function.__globals__
                value = known.get(name, getattr(builtins, name, None))
                module = self._refers(value, name, at, function)
            elif operation in ("STORE_GLOBAL", "DELETE_GLOBAL"):
                text = "changes the global {}: what it remembers goes into its state vector"
                self._mistake(at, text.format(instruction.argval))
            elif operation == "RAISE_VARARGS":
                self._mistake(at, "raises an exception: where it is not defined, write NaN instead")
            elif operation in ("BUILD_SLICE", "BINARY_SLICE", "STORE_SLICE"):
                self._mistake(at, "takes a slice: read and write number by number, by index")
            elif operation == "BINARY_OP" and instruction.argrepr.startswith("**"):
                text = "uses **, whose last bit in machine code is not Python's: write x * x, or "
                self._mistake(at, text + "math.sqrt, math.exp")

    def _refers(self, thing: Any, name: str, at: tuple[str, int], law: FunctionType) -> Any:
        """Take note of what a name refers to; it is given back where its attributes matter."""
        if isinstance(thing, ModuleType):
            return thing
        if thing is print:
            text = "prints, which makes a compiled run tens of times slower: only for a short look"
            self.warnings.append(Remark(*at, text))
        elif isinstance(thing, FunctionType) and not _is_numpy(thing):
            if _module_of(thing).partition(".")[0] in OUTSIDE:
                self._outside(at, name)
            self.read(thing)
        elif callable(thing):
            self._calls(thing, name, at)
        elif isinstance(thing, CONTAINERS) or (_is_numpy(thing) and not _is_number(thing)):
            text = f"reads the global {name}, a {type(thing).__name__}, which can change: make it "
            self._mistake(at, text + "a tuple, or numbers among its constants")
        elif name not in law.__code__.co_freevars:
            self.globals.add((name, repr(thing)))
            if "." not in name and name in law.__globals__ and _is_changed(law, name):
                text = f"reads the global {name}, which a function changes: what changes goes into "
                self._mistake(at, text + "its state vector, or is a parameter")
        return None

    def _calls(self, thing: Any, name: str, at: tuple[str, int]) -> None:
        if _is_numpy(thing):
            instead = f"math.{name.rpartition('.')[2]}"
            known = hasattr(math, instead[5:])
            text = f"calls {name} of NumPy, whose last bit is not that of machine code: "
            self._mistake(at, text + (f"use {instead}" if known else "write it on plain numbers"))
        elif isinstance(thing, BuiltinFunctionType) and thing in OTHER_BITS:
            text = f"calls {name}, whose last bit in machine code is not Python's: write "
            self._mistake(at, text + OTHER_BITS[thing])
        elif _module_of(thing).partition(".")[0] in OUTSIDE or thing in (open, input):
            self._outside(at, name)

    def _outside(self, at: tuple[str, int], name: str) -> None:
        text = f"calls {name}: a law knows no clock, no files and no chance but what it is given"
        self._mistake(at, text)

    def _mistake(self, at: tuple[str, int], text: str) -> None:
        self.mistakes.append(Remark(*at, text))


def _codes(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _codes(constant)


def _is_changed(law: FunctionType, name: str) -> bool:
    """Whether a function of the law's module assigns to a global of it."""
    for other in law.__globals__.values():
        if isinstance(other, FunctionType) and other.__globals__ is law.__globals__:
            for code in _codes(other.__code__):
                if name in code.co_names and any(
                    each.opname in ("STORE_GLOBAL", "DELETE_GLOBAL") and each.argval == name
                    for each in dis.get_instructions(code)
                ):
                    return True
    return False
