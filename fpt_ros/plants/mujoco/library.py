"""MuJoCo's shared library: addresses of the C functions that the laws call."""

import ctypes
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from fpt_ros.errors import BadInput
from fpt_ros.foreign import address_of


class Functions(NamedTuple):
    """Addresses, of this process alone.

    ``copy`` is memcpy: for what C keeps in its own memory.
    """

    set_state: float
    get_state: float
    reset: float
    step: float
    forward: float
    kinematics: float
    centres: float
    velocities: float
    inverse: float
    copy: float


@cache
def bindings() -> Any:
    """The Python package ``mujoco``.

    Raises:
        BadInput: it is not installed.
    """
    try:
        import mujoco
    except ImportError as error:
        raise BadInput(
            f"plant and model 'mujoco' need MuJoCo ({error}): pip install fpt_ros[robots], or pip "
            "install mujoco"
        ) from error
    return mujoco


@cache
def functions() -> Functions:
    """The C functions of the library that the bindings have loaded.

    Raises:
        BadInput: it is not installed, or lacks one of them.
    """
    package = Path(bindings().__file__).parent
    found = sorted(
        each
        for pattern in ("libmujoco*.so*", "libmujoco*.dylib", "mujoco.dll")
        for each in package.glob(pattern)
    )
    if not found:
        raise BadInput(f"{package} holds no shared library of MuJoCo: pip install mujoco")
    library = ctypes.CDLL(str(found[0]))
    names = (
        "mj_setState",
        "mj_getState",
        "mj_resetData",
        "mj_step",
        "mj_forward",
        "mj_kinematics",
        "mj_comPos",
        "mj_comVel",
        "mj_rne",
    )
    try:
        return Functions(*(address_of(getattr(library, name)) for name in names), _memcpy())
    except AttributeError as error:
        raise BadInput(f"{found[0]} is of another version: {error}") from error


def _memcpy() -> float:
    return float(ctypes.cast(ctypes.memmove, ctypes.c_void_p).value or 0)
