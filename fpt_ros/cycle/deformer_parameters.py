"""The parameters of stage 5, the deformer."""

from fpt_ros.compensators import COMPENSATORS
from fpt_ros.cycle.approximate_model import model_parameters
from fpt_ros.cycle.denoiser import SYNCHRONISED
from fpt_ros.cycle.limits import PARAMETERS as LIMITS
from fpt_ros.cycle.stage import ANSWERING, REALTIME, ROBOT
from fpt_ros.cycle.tuned import CONTROLLED
from fpt_ros.parameters import Parameter, Values, prefixed
from fpt_ros.transformations import TRANSFORMATIONS

TRANSFORMATION = Parameter(
    "transformation",
    "fixed point transformation, by its name; none: not adaptive",
    "none",
    live=False,
)

COMPENSATOR = Parameter(
    "compensator.kind",
    "what adds to the model's effort, by its name; none: nothing",
    "none",
    live=False,
)

GAIN_SCALE = Parameter(
    "gain_scale",
    "what the range of A follows from, as fpt gain finds it, with the sign of the response's "
    "eigenvalues; fpt run tells it; 0: not known",
    0.0,
    live=False,
)

STRICT_GAIN = Parameter(
    "strict_gain",
    "refuse an A that is outside of the range in which the iteration contracts, or of which that "
    "is not known; else it is accepted with a warning",
    False,
)

PARAMETERS = (
    TRANSFORMATION,
    COMPENSATOR,
    Parameter("adaptive_from", "time at which the deformation starts", 0.0, unit="s", minimum=0.0),
    Parameter(
        "learning_delay",
        "cycles between the deformed response and the one that it is corrected to",
        1,
        minimum=1,
        maximum=1000,
        live=False,
    ),
    Parameter(
        "learning_hold",
        "correct only once every so many cycles, and hold between",
        1,
        minimum=1,
        maximum=1000,
        live=False,
    ),
    Parameter(
        "sensor_delay",
        "cycles by which the response observed is late, beside the learning delay",
        0,
        minimum=0,
        maximum=1000,
        live=False,
    ),
    Parameter(
        "weights",
        "of the response errors, per controlled coordinate; empty: ones; auto, in an experiment's "
        "file: 1 / mean diagonal of the response map (M^-1 M^ of an arm) along the motion",
        [],
    ),
    Parameter(
        "initial_response",
        "deformed response of the first cycle; empty: the desired one",
        [],
        live=False,
    ),
    GAIN_SCALE,
    STRICT_GAIN,
    SYNCHRONISED,
    Parameter("await_tuning", "a tuner is in the loop: wait for it", False, live=False),
    Parameter("effort_command", "publish the efforts for a ros2_control controller", False),
    *LIMITS,
    REALTIME,
    ROBOT,
    *ANSWERING,
    CONTROLLED,
)


def deformer_parameters(given: Values) -> tuple[Parameter, ...]:
    """Those of the stage, of the transformation, of the compensator and of the model."""
    transformation = str(given.get(TRANSFORMATION.name, TRANSFORMATION.default))
    compensator = str(given.get(COMPENSATOR.name, COMPENSATOR.default))
    return (
        *PARAMETERS,
        *TRANSFORMATIONS[transformation].parameters,
        *prefixed("compensator", COMPENSATORS[compensator].parameters),
        *model_parameters(given, live=given.get("await_tuning") is not True),
    )
