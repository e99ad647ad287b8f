"""The approximate model, held by two stages: the deformer computes with it, the tuner tunes it."""

from dataclasses import replace

from fpt_ros import registry
from fpt_ros.parameters import Parameter, Values, prefixed

MODEL = Parameter("model", "approximate model, by its registered name", kind="str", live=False)


def model_parameters(given: Values, live: bool) -> tuple[Parameter, ...]:
    """``model``, and ``approximate.NAME`` for each parameter of the model that ``given`` names.

    They are ``live`` only where nobody tunes them: a tuner starts from them and goes on from there.
    """
    name = given.get("model")
    if not isinstance(name, str):
        return (MODEL,)
    own = prefixed("approximate", registry.model(name).parameters)
    return (MODEL, *(replace(parameter, live=live) for parameter in own))
