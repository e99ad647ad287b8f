"""What nodes say about themselves on /diagnostics, once a second and at the end."""

from typing import NamedTuple

from fpt_ros.bags.schemas import decode
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.errors import BadInput
from fpt_ros.runs.cost import MEMORY, PROCESS, PROCESSOR, Report
from fpt_ros.runs.latency import CYCLES, HISTOGRAM, LARGEST, MISSED, Latencies, parse

TOPIC, TYPE = "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"


class Told(NamedTuple):
    """What one message says: latencies of the run, if any, and what nodes take of the machine."""

    latency: Latencies | None
    reports: tuple[Report, ...]


NOTHING = Told(None, ())


def told(data: bytes, namespace: str) -> Told:
    """What the nodes of one namespace say.

    Args:
        data: a message of :data:`TOPIC`.
        namespace: without ``/`` at its ends.

    Raises:
        BadInput: the message is not what it should be.
    """
    if not any(key.encode() in data for key in (HISTOGRAM, PROCESSOR)):
        return NOTHING
    latency, reports = None, []
    try:
        for status in decode(TYPE, data).status:
            where, _, node = status.name.rpartition("/")
            if where != namespace:
                continue
            values = {pair.key: pair.value for pair in status.values}
            if node == PlantSimulator.name and HISTOGRAM in values:
                latency = Latencies(
                    parse(values[HISTOGRAM]),
                    float(values[LARGEST]) / 1e3,
                    int(values[MISSED]),
                    int(values[CYCLES]),
                )
            if PROCESSOR in values and MEMORY in values:
                process = values.get(PROCESS, node)
                reports.append(
                    Report(node, process, float(values[PROCESSOR]), float(values[MEMORY]))
                )
    except BadInput:
        raise
    except Exception as error:  # whatever rosbags, or a value, stumbles over
        raise BadInput(f"the message is not a {TYPE} of the loop") from error
    return Told(latency, tuple(reports))
