"""What can go wrong, each with the exit status that the command line gives it.

Every message is one line: what is wrong, where, and what would be right.
"""

import math


class FptError(Exception):
    """Base of all errors that are reported as one line and end the program."""

    exit_status = 1


class BadInput(FptError):
    """An argument, a file or a parameter that cannot be used."""

    exit_status = 2


class RunFailed(FptError):
    """A run that began and could not go on."""


class Interrupted(FptError):
    """Ctrl-C; whatever was being recorded has been closed properly."""

    exit_status = 130


class Diverged(RunFailed):
    """The loop was lost: a quantity left its limit or ceased to be finite.

    Carries ``time`` [s], ``cycle``, ``coordinate``, ``quantity``, ``value``, ``remedy``, and the
    ``limit`` of the quantity (``inf``: none but to be finite).
    """

    def __init__(
        self,
        time: float,
        coordinate: str,
        quantity: str,
        value: float,
        limit: float = math.inf,
        remedy: str = "",
        cycle: int | None = None,
    ) -> None:
        self.time, self.coordinate = time, coordinate
        self.quantity, self.value, self.limit = quantity, value, limit
        self.cycle, self.remedy = cycle, remedy
        why = f"is over its limit of {limit:g}" if math.isfinite(value) else "is not finite"
        where = "" if cycle is None else f" in cycle {cycle}"
        hint = f" ({remedy})" if remedy else ""
        super().__init__(
            f"diverged at t = {time:.6g} s: the {quantity} of {coordinate}, {value:g}, "
            f"{why}{where}{hint}"
        )

    def because(self, remedy: str) -> "Diverged":
        """The same with a better remedy; itself where ``remedy`` is empty."""
        if not remedy:
            return self
        return Diverged(
            self.time,
            self.coordinate,
            self.quantity,
            self.value,
            self.limit,
            remedy,
            self.cycle,
        )
