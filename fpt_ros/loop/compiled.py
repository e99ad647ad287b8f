"""Laws compiled by numba, as they stand, and kept on disk.

A law is compiled for the signature of its kind and called through a pointer, so that the loop
itself is compiled once for all laws, and a user's own law costs one small compilation. The machine
code is kept in the user's cache; the folder's name tells the sources it was made of.
"""

import hashlib
import os
import shutil
from collections.abc import Callable
from functools import cache
from pathlib import Path
from time import time
from typing import Any

from fpt_ros import laws

_PACKAGE = Path(__file__).parents[1]

_SOURCES = (
    "*.py",
    "loop/*.py",
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


OPTIONS = {"error_model": "numpy", "_nrt": False}
"""Division by zero gives inf or NaN; no reference counts, as nothing is allocated."""

_registered: set[Callable[..., Any]] = set()


def _register_helpers() -> None:
    """Make the functions that laws call known to numba; laws loaded meanwhile bring new ones."""
    from numba.extending import register_jitable

    for function in laws.HELPERS:
        if function not in _registered:
            register_jitable(forceinline=True, **OPTIONS)(function)
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


@cache
def law(function: Callable[..., Any], signature: str) -> Any:
    """A law as machine code, to be given to a compiled loop."""
    numba = _numba()
    _register_helpers()
    return numba.njit(type_of(signature), cache=True, **OPTIONS)(function)


@cache
def loop(function: Callable[..., Any], functions: tuple[str, ...], arguments: str) -> Any:
    """A loop whose first arguments are laws with these signatures."""
    numba = _numba()
    _register_helpers()
    kinds = [numba.types.FunctionType(type_of(signature)) for signature in functions]
    whole = type_of(arguments)
    signature = whole.return_type(*kinds, *whole.args)
    return numba.njit(signature, cache=True, **OPTIONS)(function)
