"""``auto`` on long records: windows that overlap, so that memory stays flat.

A few windows over the whole record, the pilots, try all members. The others fit those alone that
had most of the weight there, with the pilots' Gaussian processes; the noise, the record as it is,
and the weights are each window's own. Overlaps are cross-faded.
"""

import numpy as np

from fpt_ros.denoising.offline import Found, Noise, Record, Signal, library, quantisation
from fpt_ros.denoising.offline.auto import SHORTEST, Part, part
from fpt_ros.denoising.offline.gaussian_process import Process

LONGEST, WINDOW, OVERLAP = 8192, 4096, 512
"""Longer records are done in such windows [samples]."""
PILOTS, PILOT = 4, 2048
"""Windows that try all members, and their length."""
MOST = 2
"""General smoothers, beside the spline, and special ones, that are kept."""
LEAST_SHARE = 0.1
"""Mean weight in the pilots for which a special member is kept; half of it for a general one."""


def pieces(n: int) -> list[tuple[int, int]]:
    """First and last + 1 index of windows of equal length, ``OVERLAP`` samples in common."""
    count = -(-(n - OVERLAP) // (WINDOW - OVERLAP))
    first = np.linspace(0, n - WINDOW, count).round().astype(int)
    return [(int(a), int(a) + WINDOW) for a in first]


def _pilots(record: Record, step: float) -> list[Part]:
    found = []
    length = min(PILOT, WINDOW)
    for a in np.linspace(0, len(record.y) - length, PILOTS).astype(int):
        here = slice(int(a), int(a) + length)
        y, present = record.y[here], record.present[here]
        if present.sum() >= SHORTEST and np.ptp(y[present]) > 0.0:
            found.append(part(y, present, step=step))
    return found


def _mean(weights: list[dict[str, float]]) -> dict[str, float]:
    names = {name for one in weights for name in one}
    return {n: sum(one.get(n, 0.0) for one in weights) / len(weights) for n in sorted(names)}


def _choice(pilots: list[Part]) -> library.Choice:
    general = _mean([{n: w * p.weights["general"] for n, w in p.general.items()} for p in pilots])
    special = _mean([p.weights for p in pilots])
    best = sorted(general, key=lambda name: -general[name])[:MOST]
    best = [name for name in best if general[name] > LEAST_SHARE / 2]
    kept = [n for n in sorted(special, key=lambda n: -special[n]) if special[n] > LEAST_SHARE]
    return library.Choice(frozenset(best), frozenset(kept[: MOST + 1]))


def _processes(pilots: list[Part]) -> tuple[tuple[Process, float], ...]:
    """The kernel that is the best in most pilots, as it was where it explained most."""
    best = [p.beginning.process.processes[0][0] for p in pilots]
    kernels = [process.kernel for process in best]
    common = max(kernels, key=kernels.count)
    same = [process for process in best if process.kernel == common]
    return ((same[len(same) // 2], 1.0),)


def smooth(record: Record) -> Found:
    """The estimate of a long record, of equal steps of time."""
    n = len(record.y)
    step = quantisation.least_step(record.y, record.present)
    pilots = _pilots(record, step)
    choice = _choice(pilots) if pilots else library.Choice(frozenset(), frozenset())
    known = _processes(pilots) if pilots else ()
    total, weight = np.zeros(n), np.zeros(n)
    weights: list[dict[str, float]] = []
    noises: list[Noise] = []
    windows = pieces(n)
    for a, b in windows:
        ramp = np.minimum(np.arange(1, b - a + 1), np.arange(b - a, 0, -1))
        fade = np.minimum(ramp / OVERLAP, 1.0)
        y, present = record.y[a:b], record.present[a:b]
        estimate: Signal = y
        if present.sum() >= SHORTEST and np.ptp(y[present]) > 0.0:
            found = part(y, present, choice, known, step)
            estimate = found.estimate
            weights.append(found.weights)
            noises.append(found.beginning.noise(found.impulses))
        total[a:b] += fade * estimate
        weight[a:b] += fade
        record.report(b, n)
    shares = _mean(weights)
    info = {name: round(w, 3) for name, w in shares.items() if w > 5e-4}
    return Found(
        np.asarray(total / weight), {**info, "pieces": len(windows)}, shares, _noise(noises, step)
    )


def _noise(noises: list[Noise], step: float) -> Noise:
    if not noises:
        return Noise(0.0, 0.0, 0.0, step, 0.0, 0.0)
    return Noise(
        float(np.exp(np.mean([np.log(max(x.sigma, 1e-300)) for x in noises]))),
        min(x.least for x in noises), max(x.most for x in noises), step,
        float(np.mean([x.impulses for x in noises])), float(np.mean([x.colour for x in noises])),
    )  # fmt: skip
