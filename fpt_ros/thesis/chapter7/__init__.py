"""Chapter 7, the conclusions: noise, delay and loss in the loop."""

from fpt_ros.thesis.chapter7 import (
    actuators,
    delay,
    loss,
    noise,
)

TITLE = "Conclusions: noise, delay and loss in the loop"

CLAIMS = (
    *noise.CLAIMS,
    *delay.CLAIMS,
    *loss.CLAIMS,
    *actuators.CLAIMS,
)
