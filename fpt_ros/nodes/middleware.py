"""How Fast DDS carries the loop's messages and finds its nodes: UDP, and two profiles.

UDP on the loopback device, and no shared memory: that has ports in ``/dev/shm``, of all domains of
a machine together, and a process that is killed may leave one broken: once in 270 such deaths the
graph stood still for good, over UDP not once in 450. Who has shared memory as well (``ros2 topic``,
other people's nodes) hears the graph over UDP. Sockets ask for 4 MB, of which the system gives what
``net.core.rmem_max`` allows: with its default of 0.2 MB some of what a newcomer is told of all
nodes at once did not fit, and was told again seconds later.

By default a reliable writer asks for a confirmation with every message, and restarts a timer of no
duration for every reader. Each wakes a thread of one process or another: half of all context
switches of the loop, a quarter of its CPU time. Here both happen every 20 ms while something is
unconfirmed: what was lost is sent again that much later, from the same history.

A node says that it is there every half second instead of every three: who comes later
(``fpt params``, ``ros2 param``, a node that is started again) finds a running graph in 0.5 s, where
it mostly took 2.4 s, until the next of these announcements.
"""

import os
from collections.abc import MutableMapping
from pathlib import Path

PROFILES = "FASTRTPS_DEFAULT_PROFILES_FILE"
"""Where Fast DDS 2 looks for profiles; another version or middleware does not look there."""

RANGE = "ROS_AUTOMATIC_DISCOVERY_RANGE"

TRANSPORTS = "FASTDDS_BUILTIN_TRANSPORTS"

NETWORK = Path(__file__).with_name("fast_dds.xml")
"""Nodes are looked for as far as ROS is told."""

LOCALHOST = Path(__file__).with_name("fast_dds_localhost.xml")
"""Nodes of this machine alone are looked for; all else is the same."""


def configure(environment: MutableMapping[str, str] = os.environ) -> None:
    """Choose for this process, before its first node; what the user has chosen counts more.

    ROS makes transports of its own for the range LOCALHOST, with shared memory. So the profile says
    what that range is, and ROS that it is as the profile says. Static peers are known to ROS alone.
    """
    if PROFILES in environment or TRANSPORTS in environment:
        environment.setdefault(PROFILES, str(NETWORK))
    elif environment.get(RANGE) == "LOCALHOST" and not environment.get("ROS_STATIC_PEERS"):
        environment[PROFILES] = str(LOCALHOST)
        environment[RANGE] = "SYSTEM_DEFAULT"
    else:
        environment[PROFILES] = str(NETWORK)
        environment[TRANSPORTS] = "UDPv4"
