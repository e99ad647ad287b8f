"""Laws compiled by numba, as they stand, and kept on disk.

A law is compiled for the signature of its kind and called through a pointer, so that the loop
itself is compiled once for all laws, and a user's own law costs one small compilation. For long
runs the laws are built into a loop of their own, twice as fast: the code that is there is linked
and optimised once more, which takes seconds, and gives the same bits. The machine code is kept in
the user's cache; the folder's name tells the sources it was made of.
"""

import hashlib
import os
import shutil
import warnings
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from time import time
from types import FunctionType
from typing import Any, cast

from fpt_ros import laws

_PACKAGE = Path(__file__).parents[1]

_SOURCES = (
    "*.py",
    "cycle/*.py",
    "plants/*.py",
    "trajectories/*.py",
    "disturbances/*.py",
    "transformations/*.py",
    "tuning/*.py",
    "denoising/streaming/*.py",
)
"""What the code of this package is made of; a user's own laws are checked by numba itself."""

STALE = 7 * 24 * 3600.0
"""Seconds after which the code of older sources is removed."""


@cache
def cache_directory() -> Path:
    """Where compiled code is kept: ``$XDG_CACHE_HOME/fpt_ros/KEY``."""
    base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "fpt_ros"
    digest = hashlib.sha256()
    for pattern in _SOURCES:
        for path in sorted(_PACKAGE.glob(pattern)):
            digest.update(path.read_bytes())
    return base / digest.hexdigest()[:16]


@cache
def _numba() -> Any:
    """Numba, told where its cache is."""
    import numba

    if not os.environ.get("NUMBA_CACHE_DIR"):
        folder = cache_directory()
        if not folder.exists():
            _remove_stale(folder.parent)
        numba.config.CACHE_DIR = str(folder)  # type: ignore[attr-defined]
    return numba


def _remove_stale(base: Path) -> None:
    for old in base.glob("[0-9a-f]" * 16):
        try:
            if time() - old.stat().st_mtime > STALE:
                shutil.rmtree(old, ignore_errors=True)
        except OSError:  # another process was faster
            continue


OPTIONS = {"error_model": "numpy", "_nrt": False, "forceinline": True}
"""Division by zero gives inf or NaN; no reference counts, as nothing is allocated; what is called
directly is built in."""

Signatures = tuple[str, ...]

Laws = tuple[Callable[..., Any], ...]

_registered: set[Callable[..., Any]] = set()


def _register_helpers() -> None:
    """Make the functions that laws call known to numba; laws loaded meanwhile bring new ones."""
    from numba.extending import register_jitable

    for function in laws.HELPERS:
        if function not in _registered:
            register_jitable(**OPTIONS)(function)
            _registered.add(function)


def type_of(signature: str) -> Any:
    """Numba's type of a function with this signature (see :mod:`fpt_ros.laws`)."""
    numba = _numba()
    kinds = {
        "v": numba.float64[::1],
        "f": numba.float64,
        "i": numba.int64,
        "w": numba.int64[::1],
        "m": numba.float64[:, ::1],
        "-": numba.void,
    }
    return kinds[signature[-1]](*[kinds[kind] for kind in signature[:-1]])


def _machine_code(function: Callable[..., Any], signature: Any) -> Any:
    _register_helpers()
    return _numba().njit(signature, cache=True, **OPTIONS)(function)


@cache
def law(function: Callable[..., Any], signature: str) -> Any:
    """A law as machine code, to be given to a compiled loop."""
    return _machine_code(function, type_of(signature))


@cache
def _loop(function: Callable[..., Any], signatures: Signatures, arguments: str) -> Any:
    kinds = [_numba().types.FunctionType(type_of(signature)) for signature in signatures]
    rest = type_of(arguments)
    return _machine_code(function, rest.return_type(*kinds, *rest.args))


def loop(
    function: Callable[..., Any], chosen: Laws, signatures: Signatures, arguments: str
) -> Callable[..., Any]:
    """A loop whose first arguments are laws, with these laws: called through pointers."""
    return partial(_loop(function, signatures, arguments), *map(law, chosen, signatures))


@cache
def loop_of_its_own(
    function: Callable[..., Any], chosen: Laws, signatures: Signatures, arguments: str
) -> Callable[..., Any]:
    """The same as :func:`loop`, with the laws built in.

    It is a function that calls the loop with them: inlined there, the pointers are constants, and
    what they point at is inlined as well. Nothing is typed or lowered again, which is what numba
    spends most of its time on. Made of text, as ``*rest`` costs numba half as much again.
    """
    rest = ", ".join(f"x{i}" for i in range(len(arguments) - 1))
    pointers = ", ".join(f"law{i}" for i in range(len(chosen)))
    text = f"def built_in({rest}):\n    return loop({pointers}, {rest})"
    scope = {f"law{i}": law(each, signatures[i]) for i, each in enumerate(chosen)}
    scope |= {"loop": _loop(function, signatures, arguments), "__name__": __name__}
    exec(compile(text, __file__, "exec"), scope)
    # numba's cache knows a function by its file, name and code, and not by what it calls
    parts = cache_directory().name, *map(_identity, (function, *chosen))
    digest = hashlib.sha256(repr(parts).encode()).hexdigest()[:16]
    scope["built_in"].__qualname__ = f"built_in_{digest}"
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "First-class function type")
        return cast(Callable[..., Any], _machine_code(scope["built_in"], type_of(arguments)))


def _identity(thing: Any) -> Any:
    """What tells a law from all others, and from what it was before its file was changed."""
    if not isinstance(thing, FunctionType):
        return repr(thing)
    file = os.stat(thing.__code__.co_filename)
    enclosed = [_identity(cell.cell_contents) for cell in thing.__closure__ or ()]
    return thing.__module__, thing.__qualname__, file.st_mtime_ns, file.st_size, enclosed
