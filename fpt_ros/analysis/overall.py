"""One number for all coordinates of a run."""

import math
from collections.abc import Mapping
from typing import cast

from fpt_ros.analysis.metrics import Summary
from fpt_ros.analysis.sizes import finite


def error_of_all(summary: Summary, key: str = "rms_settled") -> float | None:
    """Tracking error over all controlled coordinates: root mean square of theirs, or the largest.

    Args:
        summary: of a run.
        key: ``rms_settled``, ``rms``, ``max_settled`` or ``max``.

    Returns:
        ``None`` where one of them has none.
    """
    tracking = cast("Mapping[str, Mapping[str, float | None]]", summary["tracking"])
    found = [one[key] for one in tracking.values()]
    known = [value for value in found if value is not None]
    if not known or len(known) < len(found):
        return None
    if key.startswith("max"):
        return max(known)
    return finite(math.hypot(*known) / math.sqrt(len(known)))
