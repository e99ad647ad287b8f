"""Chapter 2: model based adaptive control and its tuning, and RFPT beside them."""

from fpt_ros.thesis.chapter2 import (
    s2_1_pseudo_inverses,
    s2_2_1_classical_tuning,
    s2_2_2_disturbed,
    s2_2_2_modified_tuning,
    s2_3_rfpt,
    s2_4_6_friction,
    s2_4_cart_beam_hamper,
    s2_5_1_inner_iteration,
    s2_5_2_warm_start,
    s2_5_coupled_masses,
    s2_6_statement,
)

TITLE = "Adaptive control based on the fixed point transformation and parameter identification"

CLAIMS = (
    *s2_2_1_classical_tuning.CLAIMS,
    *s2_2_2_modified_tuning.CLAIMS,
    *s2_2_2_disturbed.CLAIMS,
    *s2_3_rfpt.CLAIMS,
    *s2_4_cart_beam_hamper.CLAIMS,
    *s2_4_6_friction.CLAIMS,
    *s2_5_coupled_masses.CLAIMS,
    *s2_5_2_warm_start.CLAIMS,
    *s2_5_1_inner_iteration.CLAIMS,
    *s2_6_statement.CLAIMS,
    *s2_1_pseudo_inverses.CLAIMS,
)
