"""Stage 4 of the cycle: what was observed corrects the model, the gain or the weights."""

from fpt_ros.cycle.approximate_model import model_of, model_parameters
from fpt_ros.cycle.joints import Entrance
from fpt_ros.cycle.records import Layout
from fpt_ros.cycle.rows import NO_DESIRED, TuningRow
from fpt_ros.cycle.stage import ANSWERING, JOINTS, REALTIME, Input, Stage, indices
from fpt_ros.cycle.tuned import CONTROLLED, FACTOR, PRECURSOR, WEIGHT
from fpt_ros.cycle.tuning import (
    NO_COMMAND,
    TunerConstants,
    TunerMemory,
    TunerWork,
    no_regressor,
    phase_of,
    tuning_cycle,
)
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND, Command, Desired, Names, StateEstimate, Tuning
from fpt_ros.messages.topics import COMMAND, DESIRED, STATE_ESTIMATE, TUNING
from fpt_ros.parameters import Parameter, Values, flag, number, word, words
from fpt_ros.plants import Regressor
from fpt_ros.tuning import COEFFICIENTS, GAIN, TUNING_LAWS
from fpt_ros.tuning.precursor import memory_size

NONE = "none"

PARAMETERS = (
    Parameter("method", "tuning law, by its name; none: nothing is tuned", NONE, live=False),
    Parameter("precursor", "watch for oscillations of the deformed response", False, live=False),
    Parameter("precursor_guard", "lower the gain while they are there", False),
    REALTIME,
    *ANSWERING,
    JOINTS,
    CONTROLLED,
)

TUNE_FROM = Parameter("tune_from", "time at which the tuning starts", 0.0, unit="s", minimum=0.0)


def in_the_loop(values: Values) -> bool:
    """Whether a tuner with these parameters takes part in the cycle."""
    watches = values.get("precursor") is True or values.get("precursor_guard") is True
    return watches or values.get("method", NONE) != NONE


class ParameterTuner(Stage):
    """Identification of the model's coefficients, tuning of the gain or of the weights.

    The response to r_{k-1} is seen in cycle k; together with what is kept of cycle k-1 and its
    command it gives the rate, and what is tuned steps over the time between (explicit Euler).
    The precursor observer runs beside every law. State: :class:`TunerMemory`.
    """

    name = "parameter_tuner"
    output = TUNING
    memory: TunerMemory
    constants: TunerConstants
    published: Names = ()

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the stage; with a law also the law's, and the model's where that is tuned."""
        method = str(given.get("method", NONE))
        if method == NONE:
            return PARAMETERS
        law = TUNING_LAWS[method]
        model = model_parameters(given, live=False) if law.tunes == COEFFICIENTS else ()
        return (*PARAMETERS, TUNE_FROM, *law.parameters, *model)

    @property
    def inputs(self) -> tuple[Input, ...]:
        """The estimate of the cycle and the command of the cycle before; desired where needed."""
        if not self.active:
            return ()
        desired = (Input(DESIRED),) if self.law.desired else ()
        return (Input(STATE_ESTIMATE), *desired, Input(COMMAND, lag=1))

    @property
    def active(self) -> bool:
        """Whether the tuner takes part in the cycle."""
        return in_the_loop(self.values)

    def _prepare(self) -> None:
        values, method = self.values, word(self.values, "method")
        self.law = TUNING_LAWS[method]
        self.regressor: Regressor = no_regressor
        self._start: list[float] = []
        self._model: list[float] = []
        self._coefficients: Names = ()
        self.rows = 0
        if self.law.tunes == COEFFICIENTS:
            model, coefficients = model_of(values)
            if model.regressor is None:
                raise BadInput(
                    f"{self.name}.method: {method} tunes models that are linear in "
                    f"their coefficients, {word(values, 'model')} is not declared so"
                )
            self.regressor, self.rows = model.regressor, model.rows
            self._coefficients = model.coefficient_names
            self._model = coefficients
            self._start = coefficients[: len(self._coefficients)]
        joints = tuple(words(values, "joints"))
        controlled = tuple(words(values, CONTROLLED.name))
        if self.published:
            self.begin(self._joints, self._controlled)
            return
        self._estimated = Entrance(f"{self.name}, state_estimate", joints)
        self._commanded = Entrance(f"{self.name}, command", joints)
        self._desired = Entrance(f"{self.name}, desired", controlled, partial=True)
        self.entrances = {
            STATE_ESTIMATE.name: self._estimated,
            COMMAND.name: self._commanded,
            DESIRED.name: self._desired,
        }
        if self.active and joints and (controlled or not self.law.desired):
            self.begin(joints, controlled)

    def begin(self, names: Names, controlled: Names) -> None:
        """Size the state for these coordinates, the controlled ones where the law needs them."""
        n, law = len(names), self.law
        self._joints, self._controlled = names, controlled if law.desired else ()
        where = indices(self._controlled, names, f"{self.name}.method")
        c = len(self._controlled)
        if law.tunes == COEFFICIENTS:
            start, tuned = self._start, self._coefficients
        elif law.tunes == GAIN:
            start, tuned = [law.start], (GAIN,)
        else:
            weights = self._controlled if law.tunes else ()
            start, tuned = [law.start] * len(weights), tuple(WEIGHT + x for x in weights)
        self.published = (*tuned, *law.signals, PRECURSOR, FACTOR)
        constants = list(law.prepare(self.values))
        self.constants = TunerConstants(
            law=constants,
            model=self._model,
            where=where,
            reference=int(law.reference),
            guards=int(flag(self.values, "precursor_guard")),
            signals=len(law.signals),
            tune_from=number(self.values, "tune_from") if law.tunes else 0.0,
        )
        layout = Layout(
            TunerMemory,
            values=len(start),
            law=law.memory(constants, len(start), self.rows, n),
            position=n,
            velocity=n,
            desired=c,
            tracking=3 * c,
            factor=1,
            observer=memory_size(n),
        )
        self.memory, fresh = self._remember(layout)
        if fresh:
            self.memory.factor[0] = 1.0
            for i, x in enumerate(start):
                self.memory.values[i] = x
        Y = [0.0] * (self.rows * len(start))
        self.work = TunerWork([0.0] * n, [0.0] * n, Y, [0.0] * self.rows, [0.0] * c)

    def _at_start(self) -> Stage:
        start = ParameterTuner(self.values)
        if self.published and not start.published:
            start.begin(self._joints, self._controlled)
        return start

    def step(self, estimate: StateEstimate, *rest: "Desired | Command | None") -> Tuning:
        """What is tuned in cycle k; the initial values in the first cycle, without a command.

        ``rest``: the desired response of the cycle where the law needs it, and the command of the
        cycle before.
        """
        estimate = self._estimated.take(estimate)
        desired, command = NO_DESIRED, rest[-1]
        if self.law.desired:
            assert isinstance(rest[0], Desired)
            desired = self._desired.take(rest[0])
        assert command is None or isinstance(command, Command)
        names = estimate.names
        first, latest = self.clock
        _, dt = self._advance_clock(estimate.stamp)
        if not self.published:
            self.begin(names, desired.names)
        constants = self.constants
        before = (latest - first) / SECOND
        phase = phase_of(command is None, before, constants.tune_from)
        out = TuningRow([0.0] * len(self.published))
        tuning_cycle(
            self.law.update,
            self.regressor,
            constants,
            self.memory,
            self.work,
            phase,
            dt,
            estimate,
            desired,
            NO_COMMAND if command is None else self._commanded.take(command),
            out,
        )
        return Tuning(estimate.stamp, self.published, out.values)
