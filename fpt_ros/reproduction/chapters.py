"""The chapters that have claims about experiments."""

from fpt_ros.reproduction import Group, chapter2, chapter3, chapter4
from fpt_ros.reproduction.work import Done, work

CHAPTERS: dict[int, tuple[Group, ...]] = {
    2: chapter2.GROUPS,
    3: chapter3.GROUPS,
    4: chapter4.GROUPS,
}


def work_by_title(title: str) -> Done:
    """The work of the group of this title: what another process is asked for."""
    group = next(each for groups in CHAPTERS.values() for each in groups if each.title == title)
    return work(group)
