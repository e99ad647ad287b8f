"""Laws compiled by numba, as they stand, and kept on disk.

A law is compiled for the signature of its kind and called through a pointer, so that the loop
itself is compiled once for all laws, and a user's own law costs one small compilation. For long
and for many runs laws and switches are built into a specialised loop, twice as fast: the code that
is there is linked and optimised once more, which takes seconds, and gives the same bits. The
machine code is kept in the user's cache; the folder's name tells the sources it was made of.
"""

import hashlib
import os
import re
import shutil
import warnings
from collections.abc import Callable
from contextlib import suppress
from functools import cache, partial
from pathlib import Path
from time import time
from types import FunctionType
from typing import Any, cast

from fpt_ros import law_code, laws
from fpt_ros.engine import foreign_calls
from fpt_ros.engine.switches import Switches, written
from fpt_ros.engine.types import arguments_of, signature_of, type_of

_PACKAGE = Path(__file__).parents[1]

_SOURCES = (
    "*.py",
    "cycle/*.py",
    "engine/*.py",
    "messages/frames.py",
    "plants/**/*.py",
    "trajectories/*.py",
    "relaxations/*.py",
    "integrators/*.py",
    "disturbances/**/*.py",
    "transformations/*.py",
    "tuning/*.py",
    "compensators/*.py",
    "denoising/streaming/*.py",
)
"""What the code of this package is made of; a user's own laws are checked one by one."""

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

Laws = tuple[Callable[..., Any], ...]

_registered: set[Callable[..., Any]] = set()


def _register(function: Callable[..., Any]) -> None:
    """Make a function known to numba that others call."""
    from numba.extending import register_jitable

    if function not in _registered:
        register_jitable(**OPTIONS)(function)
        _registered.add(function)


def _machine_code(function: Callable[..., Any], signature: Any) -> Any:
    for helper in laws.HELPERS:  # laws loaded meanwhile bring new ones
        _register(helper)
    foreign_calls.register()
    # no lock of Python's is held: who takes the messages of a long run works beside it
    return _numba().njit(signature, cache=True, nogil=True, **OPTIONS)(function)


class NotCompiled(Exception):
    """A law that numba cannot compile; says in a few words why, with file and line."""

    def __init__(self, why: str) -> None:
        super().__init__(why)
        self.why = why


@cache
def law(function: Any, kind: Any) -> Any:
    """A law of a kind as machine code, to be given to a compiled loop; or :class:`NotCompiled`."""
    called = law_code.read(function).functions
    for each in called:
        _register(each)
    own = not function.__module__.startswith(law_code.OWN)
    try:
        code = _told_apart(function) if function.__closure__ or own else function
        return _machine_code(code, signature_of(kind))
    except Exception as error:  # numba has many kinds of them
        return NotCompiled(_why(error, function))


REASON = re.compile(
    r"^\s*(?:\w+Error: )?((?:Untyped global name|No implementation of|Cannot |Use of unsupported|"
    r"Unknown attribute|No conversion|Unsupported|Invalid use|Unification|cannot |The use of).*"
    r"|.*(?:not supported|unsupported).*)$",
    re.MULTILINE | re.IGNORECASE,
)
PLACE = re.compile(r"^\s*During: .* at (/.+) \((\d+)\)$", re.MULTILINE)


def _why(error: Exception, function: FunctionType) -> str:
    """One line of numba's many: the innermost reason, and the place in the law's own file."""
    text = re.sub(r"\x1b\[[0-9;]*m", "", str(error))
    chain = [function, *law_code.read(function).functions]
    laws_of_others = [each for each in chain if not each.__module__.startswith(law_code.OWN)]
    own = laws_of_others or chain
    outer = [f"Function(<function {each.__name__} at " for each in chain]
    reasons = [each for each in REASON.findall(text) if not any(start in each for start in outer)]
    lines = [line for line in map(str.strip, text.splitlines()) if line]
    why = (reasons or lines or [type(error).__name__])[-1 if reasons else 0]
    why = re.sub(r"<(?:built-in )?(?:function|class|module) '?([\w.]+)[^>]*>", r"\1", why)
    files = {each.__code__.co_filename for each in own}
    places = [place for place in PLACE.findall(text) if place[0] in files]
    first = (own[0].__code__.co_filename, str(own[0].__code__.co_firstlineno))
    file, line = places[0] if places else first
    return f"{file}, line {line}: {why.strip().rstrip(':. ')}"


def _told_apart(function: FunctionType) -> FunctionType:
    """A copy of a function, its name telling what it encloses and calls.

    Numba's cache knows a function by its file, name and code, and not by what it calls.
    """
    copy = FunctionType(
        function.__code__,
        function.__globals__,
        function.__name__,
        function.__defaults__,
        function.__closure__,
    )
    copy.__qualname__ = f"{function.__name__}_{_digest(_identity(function))}"
    copy.__module__ = function.__module__
    return copy


@cache
def _loop(function: Callable[..., Any]) -> Any:
    law_kinds, rest, result = arguments_of(function)
    kinds = [*law_kinds.values(), *rest.values()]
    return _machine_code(function, type_of(result)(*map(type_of, kinds)))


def _compiled_laws(function: Callable[..., Any], chosen: Laws) -> list[Any]:
    kinds = arguments_of(function)[0].values()
    found = [law(each, kind) for each, kind in zip(chosen, kinds, strict=True)]
    for each in found:
        if isinstance(each, NotCompiled):
            raise each
    return found


def loop(function: Callable[..., Any], chosen: Laws) -> Callable[..., Any]:
    """A loop whose first arguments are laws, with these laws: called through pointers.

    Raises:
        NotCompiled: one of them cannot be compiled.
    """
    return partial(_undispatched(_loop(function)), *_compiled_laws(function, chosen))


@cache
def is_specialised(function: Callable[..., Any], chosen: Laws, switches: Switches) -> bool:
    """Whether the loop with all this built in is on disk: then it is there at once."""
    folder = Path(_numba().config.CACHE_DIR)
    return any(folder.glob(f"**/*{_built_in(function, chosen, switches)}-*.nbi"))


def _built_in(function: Callable[..., Any], chosen: Laws, switches: Switches) -> str:
    """The name that tells a loop with its laws and switches from all others."""
    parts = cache_directory().name, *map(_identity, (function, *chosen)), switches
    return f"built_in_{_digest(parts)}"


@cache
def specialised_loop(
    function: Callable[..., Any], chosen: Laws, switches: Switches
) -> Callable[..., Any]:
    """The same as :func:`loop`, with the laws and the values of switches built in.

    It is a function that calls the loop with them: inlined there, the pointers are constants, and
    what they point at is inlined as well. Nothing is typed or lowered again, which is what numba
    spends most of its time on. Made of text, as ``*rest`` costs numba half as much again. Where it
    is on disk, its parts are not asked for: to load them would take as long again.
    """
    _, others, result = arguments_of(function)
    pointers = ", ".join(f"law{i}" for i in range(len(chosen)))
    given, scope = written(others, switches)
    text = f"def built_in({', '.join(others)}):\n    return loop({pointers}, {given})"
    scope["__name__"] = __name__
    exec(compile(text, __file__, "exec"), scope)
    scope["built_in"].__qualname__ = _built_in(function, chosen, switches)
    signature = type_of(result)(*map(type_of, others.values()))
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "First-class function type")
        if is_specialised(function, chosen, switches):
            with suppress(Exception):  # it is on disk for another processor, or spoilt
                return _undispatched(_machine_code(scope["built_in"], signature))
        scope |= {f"law{i}": each for i, each in enumerate(_compiled_laws(function, chosen))}
        scope["loop"] = _loop(function)
        return _undispatched(_machine_code(scope["built_in"], signature))


def _undispatched(code: Any) -> Callable[..., Any]:
    """Machine code of one signature, called without numba's search for the one that fits.

    The search looks at every array of the records: it takes 15 times as long as the call.
    """
    (found,) = code.overloads.values()
    return cast(Callable[..., Any], found.entry_point)


def _digest(identity: Any) -> str:
    return hashlib.sha256(repr(identity).encode()).hexdigest()[:16]


def _identity(thing: Any) -> Any:
    """What tells a law from all others, and from what it was before its files were changed."""
    if not isinstance(thing, FunctionType):
        return repr(thing)
    enclosed = [_identity(cell.cell_contents) for cell in thing.__closure__ or ()]
    if thing.__module__.startswith(law_code.OWN):  # the folder's name tells these sources
        return (*_source(thing), enclosed)
    code = law_code.read(thing)
    return (*_source(thing), enclosed, [*map(_source, code.functions)], code.globals)


def _source(function: FunctionType) -> tuple[object, ...]:
    try:
        file = os.stat(function.__code__.co_filename)
    except OSError:  # made of text
        return function.__module__, function.__qualname__, function.__code__.co_code
    return function.__module__, function.__qualname__, file.st_mtime_ns, file.st_size
