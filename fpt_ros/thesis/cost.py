"""What a tuning law costs: its arithmetic operations, counted while it works."""

from dataclasses import dataclass

import numpy as np

from fpt_ros.tuning import TUNING_LAWS, Seen


class Counted(float):
    """A number that counts what is done with it; of square roots only what follows."""

    operations = 0

    def _counted(self, value: float) -> "Counted":
        Counted.operations += 1
        return Counted(value)

    def __add__(self, other: float) -> "Counted":
        return self._counted(float(self) + float(other))

    def __sub__(self, other: float) -> "Counted":
        return self._counted(float(self) - float(other))

    def __rsub__(self, other: float) -> "Counted":
        return self._counted(float(other) - float(self))

    def __mul__(self, other: float) -> "Counted":
        return self._counted(float(self) * float(other))

    def __truediv__(self, other: float) -> "Counted":
        return self._counted(float(self) / float(other))

    def __rtruediv__(self, other: float) -> "Counted":
        return self._counted(float(other) / float(self))

    def __abs__(self) -> "Counted":
        return Counted(abs(float(self)))

    def __neg__(self) -> "Counted":
        return Counted(-float(self))

    __radd__ = __add__
    __rmul__ = __mul__


@dataclass(frozen=True)
class Cost:
    """Additions, multiplications and divisions of one update; one of a claim's evidences.

    Attributes:
        method: a tuning law of coefficients.
        rows, size: of Y, which is drawn at random.
    """

    method: str
    rows: int
    size: int

    @property
    def effort(self) -> float:
        """Next to nothing."""
        return 0.1

    def perform(self, key: str) -> int:
        """The number of operations."""
        law = TUNING_LAWS[self.method]
        constants = law.prepare(
            {p.name: p.default for p in law.parameters if p.default is not None}
        )
        random = np.random.default_rng(self.size)
        Y = [Counted(x) for x in random.normal(size=self.rows * self.size).tolist()]
        error = [Counted(x) for x in random.normal(size=self.rows).tolist()]
        memory: list[float] = [0.0] * law.memory(constants, self.size, self.rows, self.rows)
        theta: list[float] = [Counted(0.0)] * self.size
        Counted.operations = 0
        law.update(constants, memory, 0.001, theta, Seen(Y, error, (), (), ()))
        return Counted.operations

    def ending(self, result: int) -> str:
        """It always comes to its end."""
        return ""

    def command(self) -> str:
        """The line for a shell that counts them."""
        return (
            "python -c 'from fpt_ros.thesis.cost import Cost; "
            f'print(Cost("{self.method}", {self.rows}, {self.size}).perform(""))\''
        )
