"""The approximate model, held by two stages: the deformer computes with it, the tuner tunes it."""

from dataclasses import replace

from fpt_ros.parameters import Parameter, Values, group, prefixed, word
from fpt_ros.plants import MODELS, Model, made

MODEL = Parameter("model", "approximate model, by its registered name", kind="str", live=False)
PREFIX = "approximate"


def model_parameters(given: Values, live: bool) -> tuple[Parameter, ...]:
    """``model``, and ``approximate.NAME`` for each parameter of the model that ``given`` names.

    They are ``live`` only where nobody tunes them: a tuner starts from them and goes on from there.
    """
    name = given.get("model")
    if not isinstance(name, str):
        return (MODEL,)
    own = prefixed(PREFIX, MODELS[name].parameters)
    return (MODEL, *(replace(parameter, live=parameter.live and live) for parameter in own))


def model_of(values: Values) -> tuple[Model, list[float]]:
    """The model that checked parameters name, and its coefficients."""
    model = made(MODELS[word(values, "model")], values, PREFIX)
    return model, list(model.coefficients(group(values, PREFIX, model.parameters)))
