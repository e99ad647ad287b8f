"""What an experiment says about itself: the recorder's section of its parameter file."""

from fpt_ros.cycle.stage import ENDS_WITH_PLANT, REALTIME, ROBOT
from fpt_ros.parameters import Parameter, Values

NODE = "recorder"

PARAMETERS = (
    Parameter("experiment", "its name; empty: that of the parameter file", "", live=False),
    Parameter("variant", "its name; empty: that of the parameter files", "", live=False),
    Parameter("title", "what it is, in a few words", "", live=False),
    Parameter("shows", "what it shows", "", live=False),
    Parameter("thesis", "section and figures of the thesis", "", live=False),
    Parameter(
        "settle_time",
        "from here on the settled error counts",
        0.0,
        unit="s",
        minimum=0.0,
        live=False,
    ),
    Parameter(
        "circumstance",
        "the variant is no controller, but what controllers meet: fpt compare lays them over it",
        False,
        live=False,
    ),
    Parameter("cycles", "length of the run; 0: not known", 0, minimum=0, live=False),
    Parameter("directory", "where to record; must not exist", "", live=False),
    Parameter(
        "split",
        "go on in another file after a size or a duration, as in 100MB or 60s; empty: never",
        "",
        live=False,
    ),
    Parameter("await_tuning", "a tuner is in the loop: its topic is part of it", False, live=False),
    REALTIME,
    ROBOT,
    ENDS_WITH_PLANT,
)


def parameters(given: Values) -> tuple[Parameter, ...]:
    """Parameters of the recorder, in the form of a stage's."""
    return PARAMETERS
