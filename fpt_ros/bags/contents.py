"""What a recording of this package says beside its messages: parameters, changes, how it ended."""

from dataclasses import dataclass, field

from fpt_ros.bags import begun_again, changes, diagnostics, parameter_text
from fpt_ros.bags.bag import END, INFO, Bag
from fpt_ros.bags.block import Block, Source
from fpt_ros.bags.loop_series import loop_topic
from fpt_ros.bags.scan import CUT
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND
from fpt_ros.parameters import Value
from fpt_ros.runs.changes import Change
from fpt_ros.runs.cost import Costs
from fpt_ros.runs.latency import Latencies


@dataclass
class Aside:
    """What a run's recording holds beside the topics of its loop."""

    bag: Bag
    latency: Latencies | None = None
    costs: Costs = field(default_factory=Costs)
    changes: list[Change] = field(default_factory=list)
    begun_again: list[int] = field(default_factory=list)

    def is_of_the_loop(self, source: Source) -> bool:
        """Whether it is a topic of the run's own loop."""
        namespace = self.bag.metadata.get(INFO, {}).get("namespace")
        own = namespace is None or _prefix(source) == namespace.strip("/")
        return loop_topic(source) is not None and own

    def take(self, block: Block) -> None:
        """Look for what nodes say of themselves, changes, and where the run begins again."""
        for source, rows in block.rows.items():
            told = source == Source(diagnostics.TOPIC, diagnostics.TYPE)
            kind = source.topic.rpartition("/")[2], source.type
            reset = kind == (begun_again.TOPIC, begun_again.TYPE)
            if not (told or reset or kind == (changes.TOPIC, changes.TYPE)):
                continue
            for stamp, start, end, _ in rows.tolist():
                data = bytes(block.data[start:end])
                try:
                    if told:
                        said = diagnostics.told(data, self._namespace())
                        self.latency = said.latency or self.latency
                        for report in said.reports:
                            self.costs.add(report)
                    elif reset:
                        begun = begun_again.stamp(data)
                        if begun not in self.begun_again:  # told again by a plant started again
                            self.begun_again.append(begun)
                    else:
                        change = changes.change(data)
                        if change not in self.changes:  # told again by a node started again
                            self.changes.append(change)
                except BadInput as error:
                    raise BadInput(
                        f"{self.bag.path}: {source.topic} at {stamp / SECOND:g} s: {error}"
                    ) from error

    def _namespace(self) -> str:
        return self.bag.metadata.get(INFO, {}).get("namespace", "").strip("/")


def told_of_resets(about: dict[str, str], aside: Aside) -> dict[str, str]:
    """What a recording says of itself, with where its run begins again, if it does."""
    stamps = aside.begun_again
    return {**about, **({begun_again.TOPIC: begun_again.text(stamps)} if stamps else {})}


def parameters(bag: Bag) -> dict[str, dict[str, Value]]:
    """Of all nodes, as the recording holds them.

    Raises:
        BadInput: it holds none.
    """
    text = bag.attachments.get(parameter_text.NAME)
    where = str(bag.path if len(bag.files) > 1 else bag.files[0])
    if text is None:
        raise BadInput(
            f"{where} is not whole, and ends before the parameters: nothing can be read"
            if bag.missing and not (bag.kinds or bag.attachments)
            else f"{where} holds no parameters: it has to be a recording of this package"
        )
    return parameter_text.from_text(text, where)


def ending(bag: Bag) -> dict[str, str]:
    """What the recording says of itself, with how it ended."""
    about = {**bag.metadata.get(INFO, {})}
    end = bag.metadata.get(END, {})
    if bag.missing:
        return {
            **about,
            "complete": "false",
            "reason": bag.reason,
            "missing": "; ".join(bag.missing),
        }
    if about and not end:
        return {**about, "complete": "false", "reason": CUT}
    if not about and not end:
        return {"complete": "true", "reason": ""}
    complete, reason = end.get("complete", "false"), end.get("reason", "")
    return {**about, "complete": complete, "reason": reason}


def _prefix(source: Source) -> str:
    return source.topic.rpartition("/")[0].strip("/")


def namespace(bag: Bag) -> str:
    """The one namespace whose loop is recorded, as in ``/robot1``; ``/`` for none."""
    found = {_prefix(source) for source in bag.kinds if loop_topic(source)}
    given = bag.metadata.get(INFO, {}).get("namespace")
    if given is not None:
        found = {given.strip("/")}
    if len(found) > 1:
        names = ", ".join(f"/{name}" for name in sorted(found))
        raise BadInput(f"{bag.path} holds the loops of {names}: record one namespace a bag")
    return f"/{found.pop()}" if found else "/"
