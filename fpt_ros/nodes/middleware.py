"""How Fast DDS makes sure of the loop's messages, and how nodes are found: ``fast_dds.xml``.

By default a reliable writer asks for a confirmation with every message, and restarts a timer of no
duration for every reader. Each wakes a thread of one process or another: half of all context
switches of the loop, a quarter of its CPU time. Here both happen every 20 ms while something is
unconfirmed: what was lost is sent again that much later, from the same history.

A node says that it is there every half second instead of every three: who comes later
(``fpt params``, ``ros2 param``, a node that is started again) finds a running graph in 0.5 s, where
it mostly took 2.4 s, until the next of these announcements.
"""

import os
from pathlib import Path

VARIABLE = "FASTRTPS_DEFAULT_PROFILES_FILE"
"""Where Fast DDS 2 looks for profiles; another version or middleware does not look there."""

PROFILE = Path(__file__).with_name("fast_dds.xml")


def configure() -> None:
    """Choose the profile for this process, before its first node; the user's own counts more."""
    os.environ.setdefault(VARIABLE, str(PROFILE))
