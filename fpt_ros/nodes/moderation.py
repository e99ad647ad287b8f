"""Moderation of wake-ups, as network cards have it: a reader sleeps while messages gather.

Fast DDS wakes a thread of the reader for every message. Who sends it pays: 35 us where another core
of a virtual machine has to be woken, four times what the message itself costs. A reader that
looks every few milliseconds needs no more than one wake-up for all that has come since.

So the thread that receives is given a function to call for every message, the C library's
``nanosleep``, and we say whether it sleeps: the time is in our memory. It needs nothing of Python.
What comes meanwhile waits in the socket, which has room for hundreds of messages.
"""

import ctypes
from collections.abc import Sequence
from contextlib import suppress
from time import sleep

from rclpy.subscription import Subscription

from fpt_ros.messages.frames import SECOND

FALLING_ASLEEP, ASLEEP, NAP = 0.0005, 0.0035, 0.004
"""Seconds in which the receiving thread may fall asleep, for which it sleeps (below 1), of both."""

_AT_ONCE = -1
"""No time at all, so that ``nanosleep`` returns; of 0 it makes some 50 us."""


class _Time(ctypes.Structure):
    """struct timespec."""

    _fields_ = (("seconds", ctypes.c_long), ("nanoseconds", ctypes.c_long))


class Moderation:
    """Of a node that has a process of its own, while it is open."""

    def __init__(self, subscriptions: Sequence[Subscription]) -> None:
        """``subscriptions``: all that have messages every cycle."""
        self._handles = [each.handle for each in subscriptions]
        self._time = _Time(0, _AT_ONCE)
        self._set(True)

    def nap(self) -> None:
        """Let messages gather; then they are there to be taken."""
        self._time.nanoseconds = int(ASLEEP * SECOND)
        sleep(FALLING_ASLEEP)
        self._time.nanoseconds = _AT_ONCE
        sleep(NAP - FALLING_ASLEEP)

    def close(self) -> None:
        """Each message wakes the thread again; before the subscriptions go."""
        self._set(False)

    def _set(self, on: bool) -> None:
        with suppress(AttributeError, OSError):  # another rcl: every message wakes the thread
            function = ctypes.CDLL("librcl.so").rcl_subscription_set_on_new_message_callback
            function.argtypes = (ctypes.c_void_p,) * 3
            asleep = ctypes.cast(ctypes.CDLL(None).nanosleep, ctypes.c_void_p)
            given = (asleep, ctypes.addressof(self._time)) if on else (None, None)
            for handle in self._handles:
                with handle:
                    # its second argument, how many messages, is where nanosleep would tell what is
                    # left of an interrupted sleep; that is no address, and so it tells nothing
                    function(handle.pointer, *given)
