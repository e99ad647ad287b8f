"""A trial call of each law of a loop, so that a mistake in one ends in one line.

Machine code does not look whether an index is within its vector: a law that writes one number too
many would change somebody else's memory. So each law is read (:mod:`fpt_ros.law_code`), and called
once as Python, on copies, before anything is compiled. What was found good is not asked again.
"""

import io
import traceback
from collections.abc import Callable, Sequence
from contextlib import redirect_stdout
from inspect import signature
from types import FunctionType
from typing import Any

from fpt_ros import law_code
from fpt_ros.cycle.stages import Loop
from fpt_ros.errors import BadInput
from fpt_ros.experiments.law_trial import Trial
from fpt_ros.experiments.law_trials import laws_of, trials
from fpt_ros.experiments.watched import Misuse, Watched
from fpt_ros.notices import notice

_good: dict[tuple[object, ...], None] = {}

KEPT = 256
"""Combinations of laws that a process remembers to be good."""


def check_laws(loop: Loop) -> None:
    """Each law takes what its kind gives, writes what it has to, and does nothing else.

    Raises:
        BadInput: one does not; the message names the law, its file, the line and the remedy.
    """
    key = laws_of(loop)
    if key in _good:
        return
    told: set[law_code.Remark] = set()  # an integrator calls the response, which has its own trial
    for trial in trials(loop):
        _check(trial, told)
    if len(_good) >= KEPT:
        _good.pop(next(iter(_good)))
    _good[key] = None


def _check(trial: Trial, told: set[law_code.Remark]) -> None:
    law, names = trial.law, trial.takes
    if not callable(law):
        raise BadInput(f"{trial.name} is a {type(law).__name__}, not a function")
    code = law_code.read(law)
    for file, line, text in code.mistakes:
        raise BadInput(f"{trial.name} ({file}, line {line}) {text}")
    for remark in code.warnings:
        if remark not in told:
            told.add(remark)
            notice(f"{trial.name} ({remark.file}, line {remark.line}) {remark.text}")
    try:
        signature(law).bind(*names)
    except (TypeError, ValueError) as error:
        raise BadInput(
            f"{_at(trial)} has other arguments, it takes ({', '.join(names)}): {error}"
        ) from error
    for arguments in trial.calls():
        _call(trial, arguments)


def _call(trial: Trial, arguments: Sequence[Any]) -> None:
    try:
        with redirect_stdout(io.StringIO()):
            result = trial.law(*arguments)
    except Misuse as error:
        raise BadInput(f"{_at(trial, error)} {error}") from error
    except ArithmeticError:
        return  # not defined at this place
    except ValueError as error:
        if "domain" in str(error) or "range" in str(error):
            return
        raise _raised(trial, error) from error
    except Exception as error:
        raise _raised(trial, error) from error
    if trial.gives_number:
        if hasattr(result, "__len__") or not hasattr(result, "__float__"):
            raise BadInput(f"{_at(trial)} returns a {type(result).__name__}: it returns a number")
    elif result is not None:
        raise BadInput(
            f"{_at(trial)} returns a {type(result).__name__}: its results are written into "
            f"{' and '.join(trial.written())}, it returns nothing"
        )
    try:
        for vector in _vectors(arguments):
            vector.check()
    except Misuse as error:
        raise BadInput(f"{_at(trial)} {error}") from error


def _raised(trial: Trial, error: Exception) -> BadInput:
    why = str(error).splitlines()[0] if str(error) else "no reason given"
    return BadInput(
        f"{_at(trial, error)} raises {type(error).__name__} ({why}): a law computes with numbers, "
        "and writes NaN where it is not defined"
    )


def _vectors(arguments: Sequence[Any]) -> list[Watched]:
    """All vectors, those of records too."""
    found = []
    for each in arguments:
        if isinstance(each, Watched):
            found.append(each)
        elif isinstance(each, tuple):
            found += _vectors(each)
    return found


def _at(trial: Trial, error: Exception | None = None) -> str:
    """The law with file and line: where the error came from in its file, or where it begins."""
    law: Callable[..., Any] = trial.law
    if not isinstance(law, FunctionType):
        return f"{trial.name} ({law!r})"
    file, line = law.__code__.co_filename, law.__code__.co_firstlineno
    if error is not None:
        ours = {file, *(each.__code__.co_filename for each in law_code.read(law).functions)}
        for frame in traceback.extract_tb(error.__traceback__):
            if frame.filename in ours:
                file, line = frame.filename, frame.lineno or line
    return f"{trial.name} ({file}, line {line})"
