"""Stage 3 of the cycle: the nominal motion, and the response that makes the error decay."""

from fpt_ros import registry
from fpt_ros.error_relaxation import RELAXATIONS
from fpt_ros.errors import BadInput
from fpt_ros.loop.stage import REALTIME, Input, Stage, indices
from fpt_ros.messages.frames import Desired, Names, StateEstimate
from fpt_ros.messages.topics import DESIRED, STATE_ESTIMATE
from fpt_ros.parameters import Parameter, Values, number, numbers, word, words

PARAMETERS = (
    Parameter("trajectory", "nominal motion, by its registered name", kind="str", live=False),
    Parameter("controlled", "coordinates that follow it", kind="strings", live=False),
    Parameter("amplitude", "scale of the nominal motion, per coordinate", kind="floats"),
    Parameter("frequency", "scale of its time, per coordinate", kind="floats", unit="1/s"),
    Parameter("lambda", "decay rate Lambda of the tracking error", unit="1/s", above=0.0),
    Parameter(
        "error_relaxation",
        "how the tracking error is to decay",
        "pid",
        choices=tuple(sorted(RELAXATIONS)),
        live=False,
    ),
    REALTIME,
)


class TrajectoryGenerator(Stage):
    """Kinematic prescription of the desired response.

    ``controlled`` are the coordinates that follow the nominal motion.

    State, for each of the c controlled coordinates: the integral of the tracking error (c numbers),
    then the error of the latest cycle (c numbers), which the next cycle adds to it: forward
    rectangles over the time that really passed.
    """

    name = "trajectory_generator"
    output = DESIRED

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the stage."""
        return PARAMETERS

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The estimate of the cycle."""
        return (Input(STATE_ESTIMATE),)

    def _prepare(self) -> None:
        values = self.values
        self.controlled = tuple(words(values, "controlled"))
        self._amplitude = numbers(values, "amplitude")
        self._frequency = numbers(values, "frequency")
        self._lambda = number(values, "lambda")
        c = len(self.controlled)
        if not 0 < c == len(set(self.controlled)):
            raise BadInput(
                f"{self.name}.controlled: {list(self.controlled)} is not valid, it takes one or "
                "more different coordinates of the plant"
            )
        for name, given in (("amplitude", self._amplitude), ("frequency", self._frequency)):
            if len(given) != c:
                wanted = ", ".join(self.controlled)
                raise BadInput(f"{self.name}.{name}: {len(given)} given, {c} needed ({wanted})")
        self._nominal = registry.trajectory(word(values, "trajectory")).nominal
        self._relax = RELAXATIONS[word(values, "error_relaxation")]
        self._names: Names = ()
        if not self.state:
            self.state.extend([0.0] * (2 * c))

    def step(self, estimate: StateEstimate) -> Desired:
        """Nominal motion at t_k and the desired response, for the controlled coordinates."""
        stamp, names, q, v, _ = estimate
        if names is not self._names:
            self._where = indices(self.controlled, names, f"{self.name}.controlled")
            self._names = names
        t, dt = self._advance_clock(stamp)
        c, state = len(self.controlled), self.state
        nominal_q, nominal_v, response = [0.0] * c, [0.0] * c, [0.0] * c
        self._nominal(self._amplitude, self._frequency, t, nominal_q, nominal_v, response)
        for i in range(c):
            state[i] += dt * state[c + i]
            at = self._where[i]
            error = nominal_q[i] - q[at]
            response[i] = self._relax(
                self._lambda, response[i], error, nominal_v[i] - v[at], state[i]
            )
            state[c + i] = error
        return Desired(stamp, self.controlled, nominal_q, nominal_v, response)
