"""Units of the numbers of a recording, where they are known."""

from collections.abc import Mapping

from fpt_ros.bags.columns import Column
from fpt_ros.bags.definitions import full_name
from fpt_ros.errors import BadInput
from fpt_ros.parameters import Value
from fpt_ros.plants import PLANTS, Plant, made

_POSITION = {"position", "positions"}
_RATE = {"velocity": "/s", "velocities": "/s"}
_EFFORT = {"effort"}

_FIELDS = {
    ("sensor_msgs/msg/Imu", "angular_velocity"): "rad/s",
    ("sensor_msgs/msg/Imu", "linear_acceleration"): "m/s^2",
    ("sensor_msgs/msg/Temperature", "temperature"): "degC",
    ("sensor_msgs/msg/FluidPressure", "fluid_pressure"): "Pa",
    ("sensor_msgs/msg/MagneticField", "magnetic_field"): "T",
    ("sensor_msgs/msg/BatteryState", "voltage"): "V",
    ("sensor_msgs/msg/BatteryState", "current"): "A",
    ("sensor_msgs/msg/Range", "range"): "m",
    ("geometry_msgs/msg/Vector3Stamped", "vector"): "",
}
"""As the definitions of the messages say, by the first word of the field."""


def plant_of(parameters: Mapping[str, Mapping[str, Value]]) -> Plant | None:
    """The plant that a recording of ours names; ``None``: it names none that is known here."""
    values = parameters.get("plant_simulator", {})
    try:
        return made(PLANTS[str(values["plant"])], values, "exact")
    except (BadInput, KeyError, TypeError):
        return None


def plant_units(
    parameters: Mapping[str, Mapping[str, Value]],
) -> tuple[Mapping[str, str], Mapping[str, str]]:
    """Of position and effort, by coordinate, of the plant that a recording of ours names."""
    plant = plant_of(parameters)
    if plant is None:
        return {}, {}
    names = plant.coordinates
    return (
        dict(zip(names, plant.units, strict=True)),
        dict(zip(names, plant.effort_units, strict=True)),
    )


def unit(
    type: str, column: Column, positions: Mapping[str, str], efforts: Mapping[str, str]
) -> str:
    """Of one number; empty: not known."""
    last = column.path.rpartition(".")[2]
    if column.path.endswith("stamp.sec") or column.path.endswith("time_from_start.sec"):
        return "s"
    if column.path.endswith("nanosec"):
        return "ns"
    own = positions.get(column.joint, "")
    if own and last in _POSITION:
        return own
    if own and last in _RATE:
        return f"{own}/s"
    if own and last == "accelerations":
        return ""  # the response, of whatever order the model has
    if column.joint in efforts and last in _EFFORT:
        return efforts[column.joint]
    return _FIELDS.get((full_name(type), column.path.partition(".")[0]), "")
