"""How Fast DDS confirms the loop's messages: a few times a second, not with every message.

By default a reliable writer asks, with every message, for a confirmation. Each one wakes two
threads of either process, which costs as much as the message itself. Here it asks every 20 ms while
something is unconfirmed: what was lost is sent again that much later, from the same history.
"""

import os
from collections.abc import Mapping
from pathlib import Path

PROFILE = """<?xml version="1.0" encoding="UTF-8" ?>
<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <data_writer profile_name="fpt_ros" is_default_profile="true">
    <qos><disable_heartbeat_piggyback>true</disable_heartbeat_piggyback></qos>
    <times><heartbeat_period><sec>0</sec><nanosec>20000000</nanosec></heartbeat_period></times>
  </data_writer>
</profiles>
"""

VARIABLES = ("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE")
"""Names of the variable in Fast DDS 2 and 3; other middleware does not look at them."""


def environment(folder: Path) -> Mapping[str, str]:
    """Variables for the processes, with the profile in ``folder``; none where the user has one."""
    if any(os.environ.get(name) for name in VARIABLES):
        return {}
    path = folder / "fastdds.xml"
    path.write_text(PROFILE)
    return dict.fromkeys(VARIABLES, str(path))
