"""One number of a topic, of recordings of other robots."""

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from damaged import recording
from mcap.writer import Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from fpt_ros.bags.one_field import read_field
from fpt_ros.bags.schemas import schema
from fpt_ros.errors import BadInput
from fpt_ros.messages.topics import JOINT_STATE

NAN = float("nan")
Row = tuple[int, Sequence[str], Sequence[float], Sequence[float]]


def joints(path: Path, rows: Sequence[Row]) -> Path:
    """(time, names, positions, velocities) as messages of /joint_states; efforts are empty."""
    return write_joints(path, [(row[0], row) for row in rows])


def write_joints(path: Path, rows: Sequence[tuple[int, Row]]) -> Path:
    """The same, recorded at times [ns] of another clock than that of their stamps [s]."""
    store = get_typestore(Stores.ROS2_JAZZY)
    kinds = store.types
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start("ros2")
        text = schema(JOINT_STATE).text.encode()
        channel = writer.register_channel(
            "/joint_states", "cdr", writer.register_schema(JOINT_STATE, "ros2msg", text)
        )
        for log_time, (stamp, names, position, velocity) in rows:
            header = kinds["std_msgs/msg/Header"](
                stamp=kinds["builtin_interfaces/msg/Time"](sec=stamp, nanosec=0), frame_id=""
            )
            message = kinds[JOINT_STATE](
                header=header,
                name=list(names),
                position=np.array(position, dtype=float),
                velocity=np.array(velocity, dtype=float),
                effort=np.array([]),
            )
            data = bytes(store.serialize_cdr(message, JOINT_STATE))
            writer.add_message(channel, log_time, data, log_time)
        writer.finish()
    return path


def test_two_publishers_on_a_topic(tmp_path: Path) -> None:
    rows: list[Row] = []
    for k in range(6):
        rows.append((2 * k, ("elbow", "wrist"), (k, 10.0 * k), ()))
        rows.append((2 * k + 1, ("gripper",), (100.0 + k,), ()))
    path = joints(tmp_path / "a.mcap", rows)
    found = read_field(path, "joint_states", "position", "wrist")
    assert found.name == "/joint_states.position.wrist"
    assert found.values.tolist() == [0.0, 10.0, 20.0, 30.0, 40.0, 50.0]
    assert found.stamps.tolist() == [0, 2, 4, 6, 8, 10]
    assert read_field(path, "/joint_states", "position.gripper").values[0] == 100.0
    mixed = read_field(path, "/joint_states", "position[0]")
    assert len(mixed.values) == 12
    assert "is not always the same joint's (elbow, gripper): --joint NAME" in mixed.warnings[0]


def test_changing_order_and_missing_elements(tmp_path: Path) -> None:
    rows: list[Row] = [
        (0, ("a", "b"), (1.0, 2.0), (3.0, 4.0)),
        (1, ("b", "a"), (2.1, 1.1), ()),
        (2, ("b",), (2.2,), (4.2,)),
        (3, ("a", "b"), (NAN, 2.3), (3.3, 4.3)),
    ]
    path = joints(tmp_path / "a.mcap", rows)
    a = read_field(path, "joint_states", "position", "a")
    assert np.array_equal(a.values, [1.0, 1.1, NAN], equal_nan=True)
    velocity = read_field(path, "joint_states", "velocity", "b")
    assert np.array_equal(velocity.values, [4.0, NAN, 4.2, 4.3], equal_nan=True)
    assert velocity.warnings == ()


def test_the_clock_of_the_sender(tmp_path: Path) -> None:
    """Sent at equal steps of a clock that begins at 0, recorded whenever they came."""
    count = 40
    path = tmp_path / "late.mcap"
    late = np.random.default_rng(5).uniform(0.0, 0.9, count)
    write_joints(
        path,
        [
            (round(1e9 * (1e9 + k + late[k])), (k, ("a",), (float(k),), ()))
            for k in range(count)
        ],
    )  # fmt: skip
    recorded = read_field(path, "joint_states", "position.a")
    assert recorded.stamps[0] > 1e18
    (warning,) = recorded.warnings
    assert warning == (
        "messages on joint_states were recorded at uneven times: --time header.stamp takes those "
        "at which they were sent"
    )
    sent = read_field(path, "joint_states", "position.a", clock="header.stamp")
    assert sent.stamps.tolist() == [k * 10**9 for k in range(count)]
    assert (sent.values.tolist(), sent.warnings) == (recorded.values.tolist(), ())
    with pytest.raises(BadInput, match=r"--time stamp: messages on joint_states have no such time"):
        read_field(path, "joint_states", "position.a", clock="stamp")


def test_messages_out_of_order_are_sorted(tmp_path: Path) -> None:
    rows: list[Row] = [(stamp, ("a",), (float(stamp),), ()) for stamp in (3, 1, 2)]
    found = read_field(joints(tmp_path / "a.mcap", rows), "joint_states", "position[0]")
    assert (found.stamps.tolist(), found.values.tolist()) == ([1, 2, 3], [1.0, 2.0, 3.0])


@pytest.mark.parametrize(
    ("topic", "field", "joint", "complaint"),
    [
        ("/other", "position[0]", None, "has no topic '/other': there are /joint_states"),
        ("/joint_states", "position", "c", "--joint c: /joint_states has the joints a, b"),
        ("/joint_states", "position", None, "is not one number: as in position.a"),
        ("/joint_states", "position[2]", None, "has no such number, it has header.stamp.sec"),
        ("/joint_states", "name[0]", None, "has no such number"),
        ("/joint_states", "twist.x", None, "has no such number"),
    ],
)
def test_what_is_not_there(
    tmp_path: Path, topic: str, field: str, joint: str | None, complaint: str
) -> None:
    path = joints(tmp_path / "a.mcap", [(0, ("a", "b"), (1.0, 2.0), ())])
    with pytest.raises(BadInput) as caught:
        read_field(path, topic, field, joint)
    assert complaint in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_joint_that_is_named_twice(tmp_path: Path) -> None:
    path = joints(tmp_path / "a.mcap", [(0, ("a", "a"), (1.0, 2.0), ())])
    with pytest.raises(BadInput, match="--joint a: messages on joint_states name a joint twice"):
        read_field(path, "joint_states", "position", "a")


def test_a_damaged_recording_says_so(tmp_path: Path) -> None:
    path = recording(tmp_path / "bag")
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    found = read_field(path, "joint_states", "position", "q1")
    assert found.values.tolist() == [float(k) for k in range(len(found.values))]
    assert "was cut" in found.warnings[0]


SHELF = "Shelf[<=4] shelves\nbool open\nint8[3] codes\nstring label\nshop/Shelf last\n"


def test_types_that_are_not_installed_and_other_encodings(tmp_path: Path) -> None:
    """Beside each other: a type of one's own, one without /msg/, JSON, protobuf, a service."""
    separator = "=" * 80
    text = f"{SHELF}{separator}\nMSG: shop/Shelf\nfloat32 height\nuint16[] places\n"
    store = get_typestore(Stores.ROS2_JAZZY)
    store.register(get_types_from_msg(text, "shop/msg/Shop"))
    shelf, shop = store.types["shop/msg/Shelf"], store.types["shop/msg/Shop"]
    path = tmp_path / "a.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start("")
        kinds = {
            "/shop": ("cdr", "shop/msg/Shop", "ros2msg", text.encode()),
            "/value": ("cdr", "std_msgs/Float64", "ros2msg", b"float64 data"),
            "/json": ("json", "any", "jsonschema", b"{}"),
            "/proto": ("protobuf", "x.Y", "protobuf", b"\x00"),
            "/call/_service_event": ("cdr", "no_pkg/srv/Call_Event", "ros2msg", b"no/Type x\n"),
            "/bare": ("cdr", "no_pkg/msg/None", "", b""),
        }
        channels = {
            topic: writer.register_channel(
                topic, encoding, writer.register_schema(name, form, definition)
            )
            for topic, (encoding, name, form, definition) in kinds.items()
        }
        for k in range(5):
            places = np.arange(k, dtype=np.uint16)
            message = shop(
                shelves=[shelf(height=0.5 * k, places=places)] * 2,
                open=k % 2 == 0,
                codes=np.array([1, -2, -k], dtype=np.int8),
                label="x" * k,
                last=shelf(height=1.5, places=places),
            )
            data = {
                "/shop": bytes(store.serialize_cdr(message, "shop/msg/Shop")),
                "/value": b"\x00\x01\x00\x00" + np.float64(k).tobytes(),
                "/json": json.dumps({"a": {"b": [k, True, None, "word"]}}).encode(),
            }
            for topic, channel in channels.items():
                writer.add_message(channel, k, data.get(topic, b"\xff"), k)
        writer.finish()
    for topic, field, expected in (
        ("/shop", "shelves[1].height", [0.0, 0.5, 1.0, 1.5, 2.0]),
        ("/shop", "codes[2]", [0.0, -1.0, -2.0, -3.0, -4.0]),
        ("/shop", "open", [1.0, 0.0, 1.0, 0.0, 1.0]),
        ("/value", "data", [0.0, 1.0, 2.0, 3.0, 4.0]),
        ("/json", "a.b[0]", [0.0, 1.0, 2.0, 3.0, 4.0]),
    ):
        assert read_field(path, topic, field).values.tolist() == expected, topic
    places = read_field(path, "/shop", "last.places[1]").values
    assert np.array_equal(places, [NAN, NAN, 1.0, 1.0, 1.0], equal_nan=True)
    for topic, complaint in (
        ("/proto", "is written as protobuf"),
        ("/call/_service_event", "no_pkg/srv/Call_Event"),
        ("/bare", "the recording does not say what a no_pkg/msg/None is"),
    ):
        with pytest.raises(BadInput, match=complaint):
            read_field(path, topic, "x")
