"""The one publisher of a loop topic: the first whose message could be used; others are ignored."""

from collections.abc import Callable

from rclpy.node import Node
from rclpy.topic_endpoint_info import TopicEndpointInfo

from fpt_ros.nodes.run_folder import own_publishers
from fpt_ros.nodes.take import GID_SIZE

UNKNOWN = b""
"""In the place of a GID where the middleware does not tell it: everybody is heard then."""

ABSENT = 3
"""Looks in a row at which a publisher was not there, after which it counts as gone."""


class Sender:
    """Whom a node listens to on one topic.

    A publisher that has gone (a broadcaster that was restarted) may be followed by another. Where
    the run's own publishers are known (:mod:`fpt_ros.nodes.run_folder`) they alone are heard.
    """

    def __init__(self, node: Node, topic: str, tell: Callable[[str], None]) -> None:
        """``tell`` is told, once each, whose messages are ignored."""
        self.chosen = UNKNOWN
        self._node, self._topic, self._tell = node, topic, tell
        self._strangers: set[bytes] = set()
        self._absent = 0

    def is_heard(self, gid: bytes) -> bool:
        """Whether a message of this publisher counts."""
        if gid in (self.chosen, UNKNOWN):
            return True
        if gid in self._strangers:
            return False
        own = own_publishers(self._resolved)
        if gid in own:  # one that was started in the place of another
            self.chosen = gid
            return True
        if self.chosen == UNKNOWN and not own:
            return True
        self._strangers.add(gid)
        self._tell(self._complaint(gid))
        return False

    def choose(self, gid: bytes) -> None:
        """A message of this publisher has been used."""
        if self.chosen == UNKNOWN:
            self.chosen = gid

    def look_whether_gone(self) -> None:
        """Listen to another from now on, where the one chosen is not there any more.

        Asked once a second; on a busy machine a publisher may seem to be gone for a moment.
        """
        if not self._strangers or self._about(self.chosen) is not None:
            self._absent = 0
            return
        self._absent += 1
        if self._absent >= ABSENT:
            self._tell(f"the publisher of {self._resolved} has gone, another may take its place")
            self.chosen, self._absent = UNKNOWN, 0
            self._strangers.clear()

    @property
    def _resolved(self) -> str:
        return self._node.resolve_topic_name(self._topic)

    def _about(self, gid: bytes) -> TopicEndpointInfo | None:
        for each in self._node.get_publishers_info_by_topic(self._resolved):
            if bytes(each.endpoint_gid[:GID_SIZE]) == gid:
                return each
        return None

    def _complaint(self, gid: bytes) -> str:
        about = self._about(gid)
        who = (  # who has just come has no name yet
            "somebody else"
            if about is None or "UNKNOWN" in about.node_name
            else f"{about.node_namespace.rstrip('/')}/{about.node_name}"
        )
        return (
            f"messages of {who} on {self._resolved}, which has a publisher already: end one of "
            "them, or use another ROS_DOMAIN_ID or --namespace"
        )
