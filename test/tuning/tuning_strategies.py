"""Numbers for the tests of tuning laws."""

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fpt_ros.parameters import resolve
from fpt_ros.tuning import TUNING_LAWS, Seen

DT = 1e-3

SIZE, ROWS, COORDINATES = 5, 3, 3

number = st.floats(-5.0, 5.0)

matrix = arrays(np.float64, (ROWS, SIZE), elements=number)

row = arrays(np.float64, (SIZE,), elements=number)

triple = arrays(np.float64, (ROWS,), elements=number)


class Law:
    """A law with its constants and its memory."""

    def __init__(self, name, size=SIZE, rows=ROWS, n=COORDINATES, **given_values):
        self.law = TUNING_LAWS[name]
        self.constants = self.law.prepare(resolve(self.law.parameters, given_values, "test"))
        self.memory = [0.0] * self.law.memory(self.constants, size, rows, n)

    def __call__(self, values, Y=(), E=(), tracking=(), h=(), r=()):
        """The values after one cycle."""
        values = list(map(float, values))
        Y = np.ravel(Y).tolist()
        self.law.update(
            self.constants,
            self.memory,
            DT,
            values,
            Seen(Y, list(E), list(tracking), list(h), list(r)),
        )
        return np.array(values)
