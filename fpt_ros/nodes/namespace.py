"""Which namespaces a graph can have."""

import re

from fpt_ros.errors import BadInput

LONGEST = 180
"""Letters: ROS allows 245 for a whole name, of which 47 are those of a node and its service."""


def check(namespace: str) -> str:
    """A namespace as an option gives it, with or without ``/`` in front; empty: none.

    Raises:
        BadInput: ROS knows no such names, or those of services would be too long for it.
    """
    if namespace and not re.fullmatch(r"/?[A-Za-z_]\w*(/[A-Za-z_]\w*)*", namespace, re.ASCII):
        raise BadInput(
            f"--namespace '{namespace}' is not a ROS namespace: words of letters, digits and _, "
            "joined by /"
        )
    if len(namespace) > LONGEST:
        raise BadInput(
            f"--namespace of {len(namespace)} letters: at most {LONGEST}, for ROS limits the names "
            "of services in it"
        )
    return namespace
