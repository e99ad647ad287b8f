"""Chapter 7, the conclusions: noise and delay that the feedback brings into the loop."""

from fpt_ros.thesis.chapter7 import (
    delay,
    noise,
)

TITLE = "Conclusions: noise and delay in the loop"

CLAIMS = (
    *noise.CLAIMS,
    *delay.CLAIMS,
)
