"""Chapter 3: fixed point transformations that sigmoids generate."""

from fpt_ros.thesis.chapter3 import (
    s1_1_precursor_guard,
    s3_1_1_bare_iteration,
    s3_1_1_fixed_points,
    s3_1_2_neuron,
    s3_2_1_jordan_blocks,
    s3_2_1_several_coordinates,
    s3_2_2_onset_of_chattering,
    s3_2_2_tora,
    s3_3_calculated_gain,
    s3_4_1_range_of_gains,
)

TITLE = "New generation of fixed point transformations for adaptive control"

CLAIMS = (
    *s3_1_1_fixed_points.CLAIMS,
    *s3_1_1_bare_iteration.CLAIMS,
    *s3_1_2_neuron.CLAIMS,
    *s3_2_1_several_coordinates.CLAIMS,
    *s3_2_1_jordan_blocks.CLAIMS,
    *s3_2_2_tora.CLAIMS,
    *s3_2_2_onset_of_chattering.CLAIMS,
    *s1_1_precursor_guard.CLAIMS,
    *s3_3_calculated_gain.CLAIMS,
    *s3_4_1_range_of_gains.CLAIMS,
)
