"""What nodes say about themselves on /diagnostics, once a second and at the end."""

from fpt_ros.bags.schemas import decode
from fpt_ros.errors import BadInput
from fpt_ros.runs.latency import CYCLES, HISTOGRAM, LARGEST, MISSED, Latencies, parse

TOPIC, TYPE = "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"


def latencies(data: bytes, node: str) -> Latencies | None:
    """Latencies of a run as a node reports them; ``None``: the message does not tell.

    Args:
        data: a message of :data:`TOPIC`.
        node: its fully qualified name, without the first ``/``.

    Raises:
        BadInput: the message is not what it should be.
    """
    if HISTOGRAM.encode() not in data:
        return None
    try:
        for status in decode(TYPE, data).status:
            values = {pair.key: pair.value for pair in status.values}
            if status.name == node and HISTOGRAM in values:
                return Latencies(
                    parse(values[HISTOGRAM]),
                    float(values[LARGEST]) / 1e3,
                    int(values[MISSED]),
                    int(values[CYCLES]),
                )
    except BadInput:
        raise
    except Exception as error:  # whatever rosbags, or a value, stumbles over
        raise BadInput(f"the message is not a {TYPE} of the loop") from error
    return None
