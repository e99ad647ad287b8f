"""The time of a measurement where its stamp may be of any clock, or missing."""

STEP = 1_000_000_000
"""Nanoseconds; a stamp that goes on by so much more or less than time itself is of a clock that was
set."""


class Arrivals:
    """Stamps that always go on: the sender's where they can be used, else by the time of arrival.

    Attributes:
        replaced: how many stamps were not used.
    """

    def __init__(self) -> None:
        self.replaced = 0
        self._sent = self._given = self._arrived = -1

    def stamp(self, sent: int, arrived: int) -> int:
        """The stamp [ns] of a message sent at ``sent``, by its own clock, and here at ``arrived``.

        Never less than the one before; the same where a message is repeated.
        """
        if self._given < 0:
            given = sent if sent > 0 else arrived
            self.replaced += given != sent
        elif sent == self._sent and sent > 0:
            return self._given
        else:
            waited = arrived - self._arrived
            given = self._given + sent - self._sent
            follows = self._sent > 0 and given > self._given
            if not follows or abs(sent - self._sent - waited) > STEP:
                given = self._given + max(waited, 1)
                self.replaced += 1
        self._sent, self._given, self._arrived = sent, given, arrived
        return given
