"""Stage 4 of the cycle: what was observed corrects the model, the gain or the weights."""

from collections.abc import Callable
from itertools import accumulate

from fpt_ros import registry
from fpt_ros.cycle.approximate_model import model_parameters
from fpt_ros.cycle.stage import CYCLE_TIME, REALTIME, Input, Stage, indices
from fpt_ros.cycle.tuned import FACTOR, PRECURSOR, WEIGHT
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.messages.frames import SECOND, Command, Desired, Names, StateEstimate, Tuning
from fpt_ros.messages.topics import COMMAND, DESIRED, STATE_ESTIMATE, TUNING
from fpt_ros.parameters import Parameter, Values, flag, group, number, word
from fpt_ros.tuning import COEFFICIENTS, GAIN, TuningLaw
from fpt_ros.tuning.precursor import guarded, memory_size, observe

NONE = "none"

PARAMETERS = (
    Parameter("method", "tuning law, by its name; none: nothing is tuned", NONE, live=False),
    Parameter("precursor", "watch for oscillations of the deformed response", False, live=False),
    Parameter("precursor_guard", "lower the gain while they are there", False),
    REALTIME,
    CYCLE_TIME,
)

TUNE_FROM = Parameter("tune_from", "time at which the tuning starts", 0.0, unit="s", minimum=0.0)


def in_the_loop(values: Values) -> bool:
    """Whether a tuner with these parameters takes part in the cycle."""
    watches = values.get("precursor") is True or values.get("precursor_guard") is True
    return watches or values.get("method", NONE) != NONE


@helper
def tune(
    update: Callable[..., None],
    regressor: Callable[..., None],
    reference: int,
    constants: Vector,
    where: "tuple[int, ...] | list[int]",
    dt: float,
    values: MutableVector,
    memory: MutableVector,
    last: MutableVector,
    tracking: MutableVector,
    response: Vector,
    desired: Vector,
    effort: Vector,
    r: Vector,
    w: MutableVector,
    a: MutableVector,
    Y: MutableVector,
    error: MutableVector,
    h: MutableVector,
) -> None:
    """One cycle of a tuning law: Y and E of the cycle before, now that its response is known.

    ``last``: q, v (n each) and the desired response (c) of the cycle before; ``tracking``: e, e', s
    of it (c each). w, a, h: work vectors of n, n, c numbers.
    """
    n, c = len(w), len(h)
    for i in range(n):
        w[i], a[i] = last[n + i], response[i]
    for i in range(c):
        at = where[i]
        h[i] = response[at] - desired[i]
        if reference:
            w[at] = last[n + at] + tracking[2 * c + i]
            a[at] = last[2 * n + i]
    if len(Y) > 0:
        size = len(values)
        regressor(last, last[n:], w, a, Y)
        for i in range(len(error)):
            total = 0.0
            for j in range(size):
                total += Y[i * size + j] * values[j]
            error[i] = effort[i] - total
    update(constants, memory, dt, values, Y, error, tracking, h, r)


@helper
def remember(
    where: "tuple[int, ...] | list[int]",
    last: MutableVector,
    tracking: MutableVector,
    q: Vector,
    v: Vector,
    nominal_q: Vector,
    nominal_v: Vector,
    desired: Vector,
    s: Vector,
) -> None:
    """Keep what the next cycle needs of this one."""
    n, c = len(q), len(desired)
    for i in range(n):
        last[i], last[n + i] = q[i], v[i]
    for i in range(c):
        at = where[i]
        last[2 * n + i] = desired[i]
        tracking[i] = nominal_q[i] - q[at]
        tracking[c + i] = nominal_v[i] - v[at]
        tracking[2 * c + i] = s[i]


@helper
def watch(memory: MutableVector, guards: int, r: Vector) -> None:
    """Precursor observer and guard; ``memory``: the factor of A, then that of the observer."""
    index = observe(memory[1:], r)
    if guards:
        memory[0] = guarded(memory[0], index)


@helper
def nothing_tuned(
    constants: Vector,
    memory: MutableVector,
    dt: float,
    values: MutableVector,
    Y: Vector,
    error: Vector,
    tracking: Vector,
    h: Vector,
    r: Vector,
) -> None:
    """In the place of a tuning law where there is none."""


@helper
def no_regressor(q: Vector, v: Vector, w: Vector, a: Vector, out: MutableVector) -> None:
    """In the place of a regressor where none is needed."""


OBSERVER_ONLY = TuningLaw((), lambda values: (), nothing_tuned, tunes="")


class ParameterTuner(Stage):
    """Identification of the model's coefficients, tuning of the gain or of the weights.

    The response to r_{k-1} is seen in cycle k; together with what is kept of cycle k-1 and its
    command it gives the rate, and what is tuned steps over the time between (explicit Euler).
    The precursor observer runs beside every law.

    State: what is tuned, the law's memory, what is kept of the latest cycle (see :func:`tune`),
    the factor of the gain, the observer's memory.
    """

    name = "parameter_tuner"
    output = TUNING

    @classmethod
    def parameters(cls, given: Values) -> tuple[Parameter, ...]:
        """Those of the stage; with a law also the law's, and the model's where that is tuned."""
        method = str(given.get("method", NONE))
        if method == NONE:
            return PARAMETERS
        law = registry.tuning_law(method)
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
        values = self.values
        self.law = OBSERVER_ONLY
        self.guards = flag(values, "precursor_guard")
        self.tune_from = 0.0
        self.regressor: Callable[..., None] = no_regressor
        self._coefficients: Names = ()
        self.published: Names = ()
        self.controlled: Names = ()
        self.rows = 0
        if word(values, "method") != NONE:
            self.law = registry.tuning_law(word(values, "method"))
            self.tune_from = number(values, "tune_from")
        self.constants = list(self.law.prepare(values))
        if self.law.tunes == COEFFICIENTS:
            self._model = model = registry.model(word(values, "model"))
            if model.regressor is None:
                raise BadInput(
                    f"{self.name}.method: {word(values, 'method')} tunes models that are linear in "
                    f"their coefficients, {word(values, 'model')} is not declared so"
                )
            self.regressor, self.rows = model.regressor, model.rows
            self._coefficients = model.coefficient_names

    def begin(self, names: Names, controlled: Names) -> None:
        """Size the state for these coordinates, the controlled ones where the law needs them."""
        n, law = len(names), self.law
        self.controlled = controlled if law.desired else ()
        self.where = indices(self.controlled, names, f"{self.name}.method")
        c = len(self.controlled)
        if law.tunes == COEFFICIENTS:
            parameters = group(self.values, "approximate", self._model.parameters)
            start = list(self._model.coefficients(parameters))[: len(self._coefficients)]
            self.tuned: Names = self._coefficients
        elif law.tunes == GAIN:
            start, self.tuned = [law.start], (GAIN,)
        else:
            weights = self.controlled if law.tunes else ()
            start, self.tuned = [law.start] * len(weights), tuple(WEIGHT + x for x in weights)
        self.published = (*self.tuned, *law.signals, PRECURSOR, FACTOR)
        memory = law.memory(self.constants, len(start), self.rows, n)
        *cuts, size = accumulate((len(start), memory, 2 * n + c, 3 * c, 1 + memory_size(n)))
        self._cuts = tuple(cuts)
        if not self.state:
            self.state.extend(start + [0.0] * (size - len(start)))
            self.parts()[4][0] = 1.0

    def parts(self) -> tuple[MutableVector, ...]:
        """The state: tuned values, the law's memory, last cycle, tracking, observer."""
        return self._divide(*self._cuts)

    def step(self, estimate: StateEstimate, *rest: "Desired | Command | None") -> Tuning:
        """What is tuned in cycle k; the initial values in the first cycle, without a command.

        ``rest``: the desired response of the cycle where the law needs it, and the command of the
        cycle before.
        """
        stamp, names, q, v, response, _ = estimate
        command = rest[-1]
        desired = rest[0] if self.law.desired else None
        assert command is None or isinstance(command, Command)
        assert desired is None or isinstance(desired, Desired)
        first, latest = self.clock
        before = (latest - first) / SECOND
        _, dt = self._advance_clock(stamp)
        if not self.published:
            self.begin(names, desired.names if desired is not None else ())
        values, memory, last, tracking, observer = self.parts()
        n, c = len(names), len(self.controlled)
        wanted = desired.accelerations if desired is not None else ()
        if command is not None:
            watch(observer, int(self.guards), command.accelerations)
            if before >= self.tune_from:
                work = [0.0] * n, [0.0] * n, [0.0] * (self.rows * len(values)), [0.0] * self.rows
                tune(
                    self.law.update,
                    self.regressor,
                    int(self.law.reference),
                    self.constants,
                    self.where,
                    dt,
                    values,
                    memory,
                    last,
                    tracking,
                    response,
                    wanted,
                    command.effort,
                    command.accelerations,
                    *work,
                    [0.0] * c,
                )
        if desired is not None:
            nominal = desired.positions, desired.velocities
            remember(self.where, last, tracking, q, v, *nominal, wanted, desired.combined_error)
        else:
            remember(self.where, last, tracking, q, v, (), (), (), ())
        signals = memory[: len(self.law.signals)]
        return Tuning(stamp, self.published, [*values, *signals, observer[1], observer[0]])
