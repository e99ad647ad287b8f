"""What several tests of experiments use."""

import pytest

from fpt_ros.errors import BadInput
from fpt_ros.experiments import experiment

NODES = (
    "plant_simulator",
    "denoiser",
    "trajectory_generator",
    "parameter_tuner",
    "fpt_deformer",
    "recorder",
)


def refused(*args, **kwargs):
    with pytest.raises(BadInput) as caught:
        experiment.load(*args, **kwargs)
    message = str(caught.value)
    assert "\n" not in message
    assert caught.value.exit_status == 2
    return message
