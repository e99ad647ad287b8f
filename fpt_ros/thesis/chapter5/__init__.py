"""Chapter 5: denoising in the wavelet domain."""

from fpt_ros.thesis.chapter5 import (
    s5_1_1_healing,
    s5_1_1_supervisor,
    s5_1_3_results,
    s5_1_3_table_5_1,
    s5_1_threshold_rules,
    s5_2_on_line,
)

TITLE = "Improved denoising in the wavelet domain"

CLAIMS = (
    *s5_1_threshold_rules.CLAIMS,
    *s5_1_1_supervisor.CLAIMS,
    *s5_1_1_healing.CLAIMS,
    *s5_1_3_table_5_1.CLAIMS,
    *s5_1_3_results.CLAIMS,
    *s5_2_on_line.CLAIMS,
)
