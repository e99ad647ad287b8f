"""All claims, and what they need, made once: runs and scores are read only, so tests share them."""

from dataclasses import replace
from functools import lru_cache

import samples

from fpt_ros.denoising.offline import DEFAULT
from fpt_ros.thesis.chapters import chapters
from fpt_ros.thesis.trials import Trial

CHAPTERS = (2, 3, 4, 5, 6, 7)
CLAIMS = {name: claim for n in CHAPTERS for name, claim in chapters()[n].claims.items()}


@lru_cache(maxsize=64)
def performed(source):
    """A run, or a trial; the default method takes seconds a seed, so it is tried on one."""
    if isinstance(source, Trial) and source.method == DEFAULT and not samples.whole:
        source = replace(source, seeds=source.seeds[:1])
    return source.perform("")


def judged(name):
    claim = CLAIMS[name]
    return claim.judge({key: performed(source) for key, source in claim.runs.items()})
