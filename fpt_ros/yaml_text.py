"""Reading YAML, which takes ruamel ten to a hundred milliseconds a file: the same text once."""

from copy import deepcopy
from functools import lru_cache
from typing import Any

from ruamel.yaml import YAML


def parse(text: str) -> Any:
    """What a YAML text says, as plain values of the caller's own.

    Raises:
        YAMLError: of ruamel.yaml.error; it is not YAML.
    """
    return deepcopy(_parsed(text))


@lru_cache(maxsize=128)
def _parsed(text: str) -> Any:
    return YAML(typ="safe", pure=True).load(text)
