"""The search for the parabola with the most power leaves out only what cannot win."""

import numpy as np
import pytest

from fpt_ros.denoising.offline.sweep_phase import _parabola

CELLS, PLACES = 6, np.linspace(-0.9, 0.9, 11)


def of_all(power):
    """Each parabola, counted to its end; frequencies above half the sampling rate are folded."""

    def sums(first, at, last):
        slope, bend = 0.5 * (last - first), 0.5 * (first + last - 2 * at)
        cells = [round(at + s * (slope + s * bend)) % (2 * CELLS) for s in PLACES.tolist()]
        return sum(float(row[min(i, 2 * CELLS - i)]) for row, i in zip(power, cells, strict=True))

    near = range(-CELLS, CELLS + 1)
    parabolas = ((at + a, at, at + b) for at in range(1, CELLS) for a in near for b in near)
    return max(parabolas, key=lambda each: sums(*each))


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("strong", [0.0, 0.5, 3.0])
def test_the_parabola_is_that_of_a_search_of_all(seed, strong):
    random = np.random.default_rng(seed)
    power = random.exponential(size=(len(PLACES), CELLS + 1))
    power[:, 2] += strong
    assert tuple(_parabola(power, PLACES, CELLS)) == of_all(power)
