"""Pause, resume, single steps, end of a run: services that ``ros2 service call`` calls too."""

from collections.abc import Callable

from rclpy.node import Node
from std_srvs.srv import Trigger

SERVICES = ("pause", "resume", "step", "stop", "reset")
"""Of the plant's node, all std_srvs/Trigger; ``step`` goes on for ``step_cycles`` cycles."""


class RunControl:
    """Whether the next cycle may begin.

    Attributes:
        paused: whether the run stands still, or will after the steps that are left.
        stopped: whether it is to end after this cycle.
    """

    def __init__(
        self,
        node: Node,
        steps: Callable[[], int],
        go_on: Callable[[], None],
        reset: Callable[[], str],
    ) -> None:
        """``steps``: cycles of a step; ``go_on`` is called where a run that stands still may go.

        ``reset`` lets the run begin again, or says why it cannot.
        """
        self.paused = self.stopped = False
        self._reset = reset
        self._left = 0
        self._steps, self._go_on = steps, go_on
        for name in SERVICES:
            node.create_service(Trigger, f"~/{name}", getattr(self, f"_on_{name}"))

    def may_begin(self) -> bool:
        """Whether the next cycle may begin; it counts as begun."""
        if self.paused and not self._left:
            return False
        self._left = max(0, self._left - 1)
        return True

    def pause(self) -> None:
        """Stand still after this cycle."""
        self.paused, self._left = True, 0

    def resume(self) -> None:
        """Go on."""
        self.paused = False
        self._go_on()

    def stop(self) -> None:
        """End the run with this cycle."""
        self.stopped = True
        self.resume()

    def _on_pause(self, request: Trigger.Request, answer: Trigger.Response) -> Trigger.Response:
        self.pause()
        return _answer(answer, "paused after this cycle")

    def _on_resume(self, request: Trigger.Request, answer: Trigger.Response) -> Trigger.Response:
        if not self.paused:
            return _answer(answer, "it was not paused")
        self.resume()
        return _answer(answer, "goes on")

    def _on_step(self, request: Trigger.Request, answer: Trigger.Response) -> Trigger.Response:
        self.paused = True
        self._left += self._steps()
        self._go_on()
        return _answer(answer, f"{self._left} cycles more")

    def _on_stop(self, request: Trigger.Request, answer: Trigger.Response) -> Trigger.Response:
        self.stop()
        return _answer(answer, "the run ends with this cycle")

    def _on_reset(self, request: Trigger.Request, answer: Trigger.Response) -> Trigger.Response:
        refused = "the run ends with this cycle" if self.stopped else self._reset()
        if refused:
            answer.success, answer.message = False, refused
            return answer
        stands = ", and stands still there" if self.paused else ""
        return _answer(answer, f"begins again after this cycle, parameters stay{stands}")


def _answer(answer: Trigger.Response, text: str) -> Trigger.Response:
    answer.success, answer.message = True, text
    return answer
