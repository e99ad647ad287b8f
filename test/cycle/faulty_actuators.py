"""A loop whose actuators do not do what they are told: off, braked, limited, late."""

import math
import random

from fpt_ros.cycle.run import Run
from fpt_ros.errors import Diverged
from fpt_ros.messages.frames import Command
from fpt_ros.messages.topics import COMMAND, DESIRED, JOINT_STATES


class Faulty:
    """Runs an experiment's loop; ``acts(cycle, sent)`` gives the command that acts.

    Attributes:
        errors: tracking errors, a tuple a cycle.
        commands, measured: frames of each cycle.
    """

    def __init__(self, experiment, acts, brake=lambda cycle: False):
        loop = experiment.loop()
        self.errors, self.commands, self.measured, self.desired = [], [], [], []
        advance, memory = loop.plant.advance, loop.plant.memory

        def acting(command, stamp):
            cycle, position = stamp // loop.plant.cycle_time, list(memory.position)
            self.commands.append(command)
            advance(acts(cycle, self.commands), stamp)
            if brake(cycle):
                for i, x in enumerate(position):
                    memory.position[i], memory.velocity[i], memory.effort[i] = x, 0.0, 0.0

        loop.plant.advance = acting
        self.lost = False
        try:
            for topic, frame in Run(loop).frames():
                if topic is JOINT_STATES:
                    self.measured.append(frame)
                if topic is DESIRED:
                    self.desired.append(frame)
                    self.errors.append(self._error(frame))
        except Diverged:
            self.lost = True

    def _error(self, desired):
        seen = dict(zip(self.measured[-1].names, self.measured[-1].position, strict=True))
        pairs = zip(desired.names, desired.positions, strict=True)
        return [x - seen[name] for name, x in pairs]

    def rms(self, last=0.4):
        """Over the last part of the run; infinite where it was lost."""
        if self.lost:
            return math.inf
        tail = [x for each in self.errors[int(len(self.errors) * (1 - last)) :] for x in each]
        return math.sqrt(sum(x * x for x in tail) / len(tail))


def as_sent(cycle, sent):
    return sent[-1]


def off(first, last):
    """No effort acts from one cycle up to another."""

    def acts(cycle, sent):
        nothing = [0.0] * len(sent[-1].effort)
        return sent[-1]._replace(effort=nothing) if first <= cycle < last else sent[-1]

    return acts


def cut(limit):
    def acts(cycle, sent):
        effort = [max(-limit, min(limit, x)) for x in sent[-1].effort]
        return sent[-1]._replace(effort=effort)

    return acts


def lost(part, seed=1):
    """Some commands do not come; the one before goes on acting."""
    chance, acting = random.Random(seed), []

    def acts(cycle, sent):
        if not acting or chance.random() >= part:
            acting[:] = [sent[-1]]
        return acting[0]

    return acts


def late(cycles):
    def acts(cycle, sent):
        return sent[max(0, len(sent) - 1 - cycles)]

    return acts


__all__ = ["COMMAND", "Command", "Faulty", "as_sent", "cut", "late", "lost", "off"]
