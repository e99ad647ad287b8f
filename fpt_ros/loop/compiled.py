"""Laws compiled by numba, as they stand, and kept on disk.

A law is compiled for the signature of its kind and called through a pointer, so that the loop itself
is compiled once for all laws, and a user's own law costs one small compilation. The machine code is
kept in the user's cache; the folder's name tells the sources it was made of.
"""

import hashlib
import os
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from fpt_ros import laws

_PACKAGE = Path(__file__).parents[1]


@cache
def _numba() -> Any:
    """Numba, told where its cache is and which plain functions laws may call."""
    import numba
    from numba.core import config
    from numba import extending

    if not os.environ.get("NUMBA_CACHE_DIR"):
        config.CACHE_DIR = str(cache_directory())
    assert extending
    return numba


@cache
def cache_directory() -> Path:
    """Where compiled code is kept: ``$XDG_CACHE_HOME/fpt_ros/KEY``."""
    base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    digest = hashlib.sha256()
    for path in sorted(_PACKAGE.rglob("*.py")):
        if path.parent.name not in ("cli", "nodes", "analysis", "bags"):
            digest.update(path.read_bytes())
    return base / "fpt_ros" / digest.hexdigest()[:16]


_registered: set[Callable[..., Any]] = set()


def _register_helpers() -> None:
    """Make the functions that laws call known to numba; laws loaded meanwhile bring new ones."""
    numba = _numba()
    for function in laws.HELPERS:
        if function not in _registered:
            numba.extending.register_jitable(error_model="numpy")(function)
            _registered.add(function)


def type_of(signature: str) -> Any:
    """Numba's type of a function with this signature (:data:`fpt_ros.laws.Signature`)."""
    numba = _numba()
    kinds = {
        "v": numba.float64[::1],
        "f": numba.float64,
        "i": numba.int64,
        "w": numba.int64[::1],
        "m": numba.float64[:, ::1],
        "-": numba.void,
    }
    *arguments, result = signature
    return kinds[result](*[kinds[kind] for kind in arguments])


@cache
def law(function: Callable[..., Any], signature: str) -> Any:
    """A law as machine code, to be given to a compiled loop."""
    _register_helpers()
    numba = _numba()
    return numba.njit(type_of(signature), cache=True, error_model="numpy")(function)


@cache
def loop(function: Callable[..., Any], functions: tuple[str, ...], arguments: str) -> Any:
    """A loop whose first arguments are laws with these signatures."""
    _register_helpers()
    numba = _numba()
    kinds = [numba.types.FunctionType(type_of(signature)) for signature in functions]
    whole = type_of(arguments)
    return numba.njit(whole.return_type(*kinds, *whole.args), cache=True, error_model="numpy")(
        function
    )
