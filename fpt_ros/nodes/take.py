"""Taking the bytes of a message together with who sent them.

rclpy gives the bytes and the times of a message, not its sender; rcl does, and is asked directly:
the sender's GID is what tells two publishers of one topic apart.
"""

import ctypes
from collections.abc import Callable
from ctypes import POINTER, byref, c_bool, c_char_p, c_int, c_int64, c_size_t, c_uint8, c_uint64

from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

GID_SIZE = 16

OK = 0


class _Gid(ctypes.Structure):
    _fields_ = (("implementation", c_char_p), ("data", c_uint8 * GID_SIZE))


class _Info(ctypes.Structure):
    """rmw_message_info_t of Jazzy."""

    _fields_ = (
        ("source_timestamp", c_int64),
        ("received_timestamp", c_int64),
        ("publication_sequence_number", c_uint64),
        ("reception_sequence_number", c_uint64),
        ("publisher_gid", _Gid),
        ("from_intra_process", c_bool),
    )


class _Allocator(ctypes.Structure):
    _fields_ = tuple((name, ctypes.c_void_p) for name in ("new", "free", "resize", "zero", "state"))


class _Bytes(ctypes.Structure):
    """rcutils_uint8_array_t."""

    _fields_ = (
        ("buffer", ctypes.c_void_p),
        ("length", c_size_t),
        ("capacity", c_size_t),
        ("allocator", _Allocator),
    )


Taken = tuple[bytes, bytes]
"""A serialised message, and the GID of its sender; empty where it is not known."""


def taker(subscription: Subscription) -> Callable[[], Taken | None]:
    """What takes the next message of a raw subscription; ``None``: there is none.

    Raises:
        OSError, AttributeError: this Jazzy has no rcl of the kind known here.
    """
    rcl, rcutils = ctypes.CDLL("librcl.so"), ctypes.CDLL("librcutils.so")
    rcutils.rcutils_get_default_allocator.restype = _Allocator
    take = rcl.rcl_take_serialized_message
    take.argtypes = (ctypes.c_void_p, POINTER(_Bytes), POINTER(_Info), ctypes.c_void_p)
    take.restype = c_int
    allocator, data, info = rcutils.rcutils_get_default_allocator(), _Bytes(), _Info()
    if rcutils.rcutils_uint8_array_init(byref(data), c_size_t(1024), byref(allocator)):
        raise OSError("no memory for a message")
    handle, copy = subscription.handle, ctypes.string_at
    address, data_at, info_at = handle.pointer, byref(data), byref(info)
    gid_at = ctypes.addressof(info.publisher_gid.data)

    def take_one() -> Taken | None:
        if take(address, data_at, info_at, None) != OK:
            return None
        return copy(data.buffer, data.length), copy(gid_at, GID_SIZE)

    return take_one


def gid_of(publisher: Publisher) -> bytes:
    """What its messages carry as their sender; empty: this Jazzy does not tell."""
    gid = _Gid()
    try:
        rcl = ctypes.CDLL("librcl.so")  # and what it is linked with
        handle = rcl.rcl_publisher_get_rmw_handle
        handle.argtypes, handle.restype = (ctypes.c_void_p,), ctypes.c_void_p
        ask = rcl.rmw_get_gid_for_publisher
        ask.argtypes, ask.restype = (ctypes.c_void_p, POINTER(_Gid)), c_int
        if ask(handle(publisher.handle.pointer), byref(gid)) != OK:
            return b""
    except (AttributeError, OSError):
        return b""
    return bytes(gid.data)
