"""Messages that cannot be used are refused, by sender, topic and what is wrong."""

import pytest

from fpt_ros.cycle.content import LATEST, check_content
from fpt_ros.errors import BadInput
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import Command
from fpt_ros.messages.topics import COMMAND

YEAR = 365 * 86_400 * 10**9


def command(stamp):
    return Command(stamp, ("q",), [0.0], [0.0])


@pytest.mark.parametrize("stamp", [0, 1_800_000_000 * 10**9, LATEST])
def test_what_follows_on_a_stamp_for_a_year_can_be_sent(stamp):
    check_content("deformer, command", COMMAND, command(stamp))
    later = command(stamp + YEAR)
    assert Codec(COMMAND).decode(Codec(COMMAND).encode(later)).stamp == later.stamp


@pytest.mark.parametrize(("stamp", "why"), [(-1, "is less than 0"), (LATEST + 1, "is after 2036")])
def test_other_stamps_are_refused(stamp, why):
    with pytest.raises(BadInput, match=f"deformer, command: the stamp, {stamp} ns, {why}"):
        check_content("deformer, command", COMMAND, command(stamp))
