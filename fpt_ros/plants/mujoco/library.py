"""MuJoCo's shared library: addresses of the C functions that the laws call."""

import ctypes
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from fpt_ros.errors import BadInput
from fpt_ros.extras import need
from fpt_ros.foreign import address_of


class Functions(NamedTuple):
    """Addresses, of this process alone.

    ``copy`` is memmove: for what C keeps in its own memory.
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
    jacobian: float
    copy: float


@cache
def bindings() -> Any:
    """The Python package ``mujoco``.

    Raises:
        BadInput: it is not installed.
    """
    need("robots")
    import mujoco

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
    names = {
        "set_state": "mj_setState",
        "get_state": "mj_getState",
        "reset": "mj_resetData",
        "step": "mj_step",
        "forward": "mj_forward",
        "kinematics": "mj_kinematics",
        "centres": "mj_comPos",
        "velocities": "mj_comVel",
        "inverse": "mj_rne",
        "jacobian": "mj_jacBody",
    }
    try:
        found_at = {ours: address_of(getattr(library, name)) for ours, name in names.items()}
        return Functions(copy=address_of(ctypes.memmove), **found_at)
    except AttributeError as error:
        raise BadInput(f"{found[0]} is of another version: {error}") from error
