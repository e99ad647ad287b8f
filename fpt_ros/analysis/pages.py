"""HTML pages from templates that share one style sheet."""

from functools import partial
from importlib.resources import files
from typing import Any

from jinja2 import ChoiceLoader, Environment, FunctionLoader, StrictUndefined


def render(template: str, package: str = "fpt_ros.analysis", **values: Any) -> str:
    """The page of a package's template; every name in it has to be given.

    What it includes, the style sheet, stands beside this file.
    """
    environment = Environment(
        loader=ChoiceLoader(
            [FunctionLoader(partial(_source, package)), FunctionLoader(_source_here)]
        ),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(template).render(values)


def _source(package: str, name: str) -> str | None:
    path = files(package).joinpath(name)
    return path.read_text(encoding="utf-8") if path.is_file() else None


_source_here = partial(_source, "fpt_ros.analysis")
