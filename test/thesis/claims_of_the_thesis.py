"""All claims, and what they need, made once: runs and scores are read only, so tests share them."""

from functools import lru_cache

from fpt_ros.thesis.chapters import chapters

CHAPTERS = (2, 3, 4, 5, 6, 7)
CLAIMS = {name: claim for n in CHAPTERS for name, claim in chapters()[n].claims.items()}


@lru_cache(maxsize=64)
def performed(source):
    return source.perform("")


def judged(name):
    claim = CLAIMS[name]
    return claim.judge({key: performed(source) for key, source in claim.runs.items()})
