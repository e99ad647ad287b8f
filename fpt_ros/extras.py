"""Packages that only some commands need: extras of the installation, ``fpt_ros[sweep]``.

setup.py names the packages of each extra; the modules named here are those that tell whether they
are there.
"""

from importlib.util import find_spec

from fpt_ros.errors import BadInput

MODULES = {
    "analysis": ("matplotlib", "jinja2", "bokeh"),
    "sweep": ("matplotlib", "pyarrow", "optuna"),
    "compare": ("matplotlib", "jinja2", "optuna"),
    "export": ("pandas", "pyarrow"),
    "denoise": ("matplotlib", "pyarrow"),
    "thesis": ("matplotlib", "jinja2", "pyarrow"),
    "robots": ("mujoco",),
    "cluster": ("dask", "distributed"),
    "peers": ("skimage", "statsmodels"),
}
"""Modules of each extra. One that several extras bring counts for the first of them."""


def need(extra: str) -> None:
    """Check that the modules of an extra can be imported, without importing them.

    Raises:
        BadInput: one of them is missing; the message says what to install.
    """
    for module in MODULES[extra]:
        if not _is_there(module):
            raise BadInput(_remedy(module, extra))


def remedy(error: BaseException | None) -> str:
    """What to install if a missing module of an extra is behind an error; empty if none is."""
    while error is not None:
        if isinstance(error, ModuleNotFoundError):
            module = (error.name or "").partition(".")[0]
            for extra, modules in MODULES.items():
                if module in modules:
                    return _remedy(module, extra)
        error = error.__cause__ or error.__context__
    return ""


def _remedy(module: str, extra: str) -> str:
    return f"{module} is not installed: pip install 'fpt_ros[{extra}]'"


def _is_there(module: str) -> bool:
    try:
        return find_spec(module) is not None
    except (ImportError, ValueError):  # ValueError: its entry in sys.modules is None
        return False
