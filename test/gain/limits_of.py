"""The limits of an experiment's gain, with settings as keywords."""

from fpt_ros.experiments.experiment import load
from fpt_ros.gain import contraction


def bounds(name, variant="adaptive", **settings):
    changes = [f"{key.replace('__', '.')}={value}" for key, value in settings.items()]
    return contraction.bounds(load(name, variant, changes))
