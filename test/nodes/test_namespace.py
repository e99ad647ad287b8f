"""The longest namespace, by ROS's own checks of names."""

from rclpy.validate_full_topic_name import validate_full_topic_name

from fpt_ros.cycle.stages import STAGES
from fpt_ros.nodes.namespace import LONGEST, check

RQ = "rq{}Request"
"""What the middleware makes of the name of a service, of which Fast DDS keeps 255 letters."""


def test_the_longest_namespace_leaves_room_for_all_services():
    namespace = check("a" * LONGEST)
    node = max(STAGES, key=len)
    for service in ("set_parameters_atomically", "get_available_transitions"):
        name = f"/{namespace}/{node}/{service}"
        validate_full_topic_name(name, is_service=True)
        assert len(RQ.format(name)) <= 255
