"""Chapter 6: adaptive multi-round smoothing with Savitzky-Golay filters."""

from fpt_ros.thesis.chapter6 import (
    s6_1_savitzky_golay,
    s6_2_1_relation,
    s6_2_2_joined_lines,
    s6_2_3_rounds,
)

TITLE = "Adaptive multi-round smoothing based on the Savitzky-Golay filter"

CLAIMS = (
    *s6_1_savitzky_golay.CLAIMS,
    *s6_2_1_relation.CLAIMS,
    *s6_2_2_joined_lines.CLAIMS,
    *s6_2_3_rounds.CLAIMS,
)
