"""Numbers and reasons of verdicts in words."""

import math
from collections.abc import Sequence

from fpt_ros.analysis import signals
from fpt_ros.analysis.tables import number_text, ratio_text
from fpt_ros.runs.run import Run


def text(value: float) -> str:
    """A number as in tables; words for one that is not finite."""
    if math.isinf(value):
        return "lost"
    return number_text(value) if math.isfinite(value) else "none"


def times(before: float, after: float) -> str:
    """How much smaller or larger, to be pictured."""
    if not (math.isfinite(after) and before):
        return "lost"
    return "from lost" if math.isinf(before) else ratio_text(after / before)


def factor_text(ratio: float) -> str:
    """How many times: three digits, 7,620 rather than 7.62e+03."""
    return f"{float(f'{ratio:.3g}'):,.0f}" if 1000.0 <= ratio < 1e6 else f"{ratio:.3g}"


def listed(words: Sequence[str]) -> str:
    """``a, b and c``."""
    return " and ".join([*[", ".join(words[:-1])] * (len(words) > 1), words[-1]])


def because(held: bool, reason: str) -> str:
    """The reason for what was expected, which must not be given where it did not happen."""
    return reason if held else "The numbers do not bear it out."


def unit(run: Run, name: str) -> str:
    """`` [rad]``, or nothing."""
    found = signals.unit(run, name)
    return f" [{found}]" if found else ""
