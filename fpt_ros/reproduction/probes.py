"""Numbers that single claims need beyond the summary of a run."""

from collections.abc import Mapping

import numpy as np

from fpt_ros.analysis import signals
from fpt_ros.analysis.metrics import largest, rms
from fpt_ros.loop.run import Array, Run


def responses(run: Run) -> Mapping[str, float]:
    """Of the settled part: rms of realised less desired response, and chatter; how far the
    coordinates move that are not controlled.
    """
    parts, steps = [], []
    for name in signals.controlled(run):
        time, desired = signals.topic(run, "desired", "accelerations", name)
        _, realised = signals.realised_response(run, name)
        late = signals.settled(run, time)[:-1]
        parts.append((realised - desired[:-1])[late])
        _, r = signals.topic(run, "command", "accelerations", name)
        steps.append(np.diff(r)[late])
    if not parts or not len(parts[0]):
        return {}
    error = np.sqrt(np.nansum(np.square(parts), axis=0))
    chatter = np.sqrt(np.nansum(np.square(steps), axis=0))
    found = {"response_error": rms(error) or 0.0, "settled_chatter": float(np.mean(chatter))}
    for name in signals.uncontrolled(run):
        _, position = signals.topic(run, "joint_states", "position", name)
        found[f"largest_{name}"] = largest(position) or 0.0
    return found


def iteration(run: Run) -> Mapping[str, float]:
    """How a bare iteration goes: steps to a small error, changes of sign, size at the end."""
    errors: Array = np.array([signals.motion(run, name).error for name in signals.controlled(run)])
    # the error of step k is seen in cycle k + 1
    errors = errors[:, 1:]
    size = np.linalg.norm(errors, axis=0)
    signs = np.sign(errors[0][np.abs(errors[0]) > 1e-9])
    turns = int(np.sum(signs[1:] != signs[:-1]))

    def steps(limit: float) -> float:
        above = np.flatnonzero(size >= limit)
        return float(above[-1] + 1) if len(above) else 0.0

    return {
        "turns": float(turns),
        "steps_1e-2": steps(1e-2),
        "steps_1e-3": steps(1e-3),
        "steps_1e-6": steps(1e-6),
        "last": float(size[-1]),
        "largest_late": float(size[-1000:].max()),
        "overshoot": float(np.max(errors[0] * -np.sign(errors[0, 0]), initial=0.0)),
    }


def windows(run: Run) -> Mapping[str, float]:
    """The rms of the known term and of the inner residual in the first and the last seconds."""
    found = {}
    for name in ("known_term", "inner_residual"):
        time, values = signals.topic(run, "tuning", "values", name)
        for label, begin, end in (("early", 2.0, 5.0), ("late", 15.0, 20.0)):
            inside = (time >= begin) & (time < end)
            if inside.any():
                found[f"{name}_{label}"] = rms(values[inside]) or 0.0
    return found


def gain(run: Run) -> Mapping[str, float]:
    """Range of the calculated gain in the settled part."""
    time, values = signals.topic(run, "tuning", "values", "A")
    late = values[signals.settled(run, time)]
    found = dict(responses(run))
    if len(late):
        found.update(least_A=float(late.min()), greatest_A=float(late.max()))
    return found


def weights(run: Run) -> Mapping[str, float]:
    """Largest weight of the settled part."""
    found = dict(responses(run))
    tuning = run.topics.get("tuning")
    if tuning is not None:
        late = signals.settled(run, signals.seconds(run, tuning.stamps))
        columns = [i for i, name in enumerate(tuning.names) if name.startswith("weight.")]
        if columns:
            found["largest_weight"] = float(tuning.vectors["values"][late][:, columns].max())
    return found
