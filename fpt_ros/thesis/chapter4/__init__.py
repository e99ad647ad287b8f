"""Chapter 4: the stretched sigmoid, time sharing, a new function, and fuzzy models."""

from fpt_ros.thesis.chapter4 import (
    s4_1_1_stretched_sigmoid,
    s4_1_2_time_sharing,
    s4_1_integrators,
    s4_2_kapitza,
    s4_3_2_tuned_weights,
    s4_3_3_affine_model,
    s4_3_4_fuzzy_models,
    s4_4_2_imprecise_models,
)

TITLE = "Advances in the sigmoid generated fixed point transformation"

CLAIMS = (
    *s4_1_1_stretched_sigmoid.CLAIMS,
    *s4_1_2_time_sharing.CLAIMS,
    *s4_2_kapitza.CLAIMS,
    *s4_3_3_affine_model.CLAIMS,
    *s4_3_2_tuned_weights.CLAIMS,
    *s4_3_4_fuzzy_models.CLAIMS,
    *s4_4_2_imprecise_models.CLAIMS,
    *s4_1_integrators.CLAIMS,
)
