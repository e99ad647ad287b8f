"""The verdicts that many claims have in common."""

import math
from collections.abc import Callable, Sequence

from fpt_ros.analysis import signals, sizes
from fpt_ros.thesis.claim import NO, ONLY_IF, YES, Verdict
from fpt_ros.thesis.measures import norms, response_errors, responses, rms, settled_rms
from fpt_ros.thesis.setup import Runs
from fpt_ros.thesis.words import factor_text, listed, unit

Judge = Callable[[Runs], Verdict]


def precise(
    better: str, worse: str, factor: float, remark: str = "", beside: Sequence[str] = ()
) -> Judge:
    """Judge of: run ``better`` tracks at least ``factor`` times as precisely as ``worse``.

    ``beside``: further runs whose errors are shown.
    """

    def judge(runs: Runs) -> Verdict:
        measured: dict[str, float | str | None] = {}
        ratios = {}
        for name in signals.controlled(runs[better]):
            before, after = settled_rms(runs[worse], name), settled_rms(runs[better], name)
            ratios[name] = before / after if after > 0.0 else math.inf
            for key in (worse, better, *beside):
                label = f"{name}, rms error, {key}{unit(runs[better], name)}"
                measured[label] = sizes.finite(settled_rms(runs[key], name))
        found = listed([f"{factor_text(ratio)} ({name})" for name, ratio in ratios.items()])
        held = [ratio >= factor for ratio in ratios.values()]
        status = YES if all(held) else ONLY_IF if any(held) else NO
        reason = f"The settled error is {found} times smaller than in '{worse}'."
        return Verdict(status, measured, f"{reason} {remark}".strip())

    return judge


def follows(adaptive: str, nonadaptive: str, factor: float, remark: str = "") -> Judge:
    """Judge of: with deformation the realised response stays close to the desired one.

    The response error has to be ``factor`` times smaller than without, and smaller by as much than
    what the deformation adds.
    """

    def judge(runs: Runs) -> Verdict:
        with_it, without = (rms(response_errors(runs[key])) for key in (adaptive, nonadaptive))
        time, desired, deformed, _ = responses(runs[adaptive])
        late = signals.settled(runs[adaptive], time)
        added = rms(norms(deformed[late] - desired[late]))
        held = with_it * factor <= without, with_it * factor <= added
        status = YES if all(held) else ONLY_IF if any(held) else NO
        measured = {
            f"realised - desired, rms, {nonadaptive}": without,
            f"realised - desired, rms, {adaptive}": with_it,
            "deformed - desired, rms": added,
        }
        reason = (
            f"Realised and desired response differ {factor_text(without / with_it)} times less "
            f"than in '{nonadaptive}', while the deformed one is {factor_text(added / with_it)} "
            "times as far away."
        )
        return Verdict(status, measured, f"{reason} {remark}".strip())

    return judge
