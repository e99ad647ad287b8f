"""As many points as can be seen, the extremes among them: chatter stays visible."""

import numpy as np

from fpt_ros.runs.run import Array


def thin(x: Array, rows: Array, bins: int, first: int = 0) -> tuple[Array, Array]:
    """Lowest and highest number of each stretch, per column.

    Args:
        x: (n,).
        rows: (n, width); NaN where nothing is known.
        bins: stretches at most.
        first: number of the first row, counted from where they began: while rows come, a stretch
            keeps its place, so that what is drawn does not tremble.

    Returns:
        (m,) and (m, width), m at most about 2 ``bins``.
    """
    n = len(x)
    if n <= 2 * bins:
        return x, rows
    size = -(-n // bins)
    start = -first % size
    count = (n - start) // size
    cut = rows[start : start + count * size].reshape(count, size, -1)
    low, high = np.fmin.reduce(cut, axis=1), np.fmax.reduce(cut, axis=1)
    rises = ~(cut[:, 0] > cut[:, -1])
    thinned = np.empty((2 * count, rows.shape[1]))
    thinned[::2], thinned[1::2] = np.where(rises, low, high), np.where(rises, high, low)
    times = x[start : start + count * size].reshape(count, size)
    return times[:, [0, size // 2]].ravel(), thinned
