"""The approximate model, held by two stages: the deformer computes with it, the tuner tunes it."""

from fpt_ros import registry
from fpt_ros.parameters import Parameter, Values, prefixed

MODEL = Parameter("model", "approximate model, by its registered name", kind="str", live=False)


def model_parameters(given: Values) -> tuple[Parameter, ...]:
    """``model``, and ``approximate.NAME`` for each parameter of the model that ``given`` names."""
    name = given.get("model")
    if not isinstance(name, str):
        return (MODEL,)
    return (MODEL, *prefixed("approximate", registry.model(name).parameters))
