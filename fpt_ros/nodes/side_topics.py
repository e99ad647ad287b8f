"""The topics beside the loop that are recorded, as they come; no cycle depends on them."""

from fpt_ros.bags import begun_again
from fpt_ros.nodes.stage_node import CHANGES

ROSOUT = "/rosout"

SIDE_TOPICS = {
    "/diagnostics": "diagnostic_msgs/msg/DiagnosticArray",
    ROSOUT: "rcl_interfaces/msg/Log",
    "/parameter_events": "rcl_interfaces/msg/ParameterEvent",
    CHANGES: "rcl_interfaces/msg/ParameterEvent",
    begun_again.TOPIC: begun_again.TYPE,
}

SIDE_DEPTH = 1000
"""Messages of a side topic that may wait to be recorded."""
