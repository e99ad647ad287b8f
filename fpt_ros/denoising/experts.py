"""Rule bases of the fuzzy supervisor (thesis section 5.1.1): four offline, two in the loop.

The thesis names the experts of the level, the rule, the wavelet and the window, with their inputs,
and prints no rule: sets and rules are decisions of this project.
"""

from fpt_ros.denoising.mamdani import Rules

SNR = (-5.0, 8.0, 20.0)
LEVEL = Rules(SNR, (0.0, 0.1, 0.3), "LL:H LM:H LH:M ML:H MM:M MH:L HL:M HM:L HH:L")
RULE = Rules((0.0, 0.5, 1.0), (0.0, 1.0, 2.0), "LL:L LM:M LH:M ML:L MM:M MH:H HL:M HM:H HH:H")
WAVELET = Rules((0.0, 0.4, 0.9), (0.0, 0.1, 0.3), "LL:H LM:H LH:M ML:H MM:M MH:M HL:M HM:L HH:L")
WINDOW = Rules(SNR, (0.1, 0.2, 0.4), "LL:H LM:M LH:L ML:H MM:M MH:L HL:M HM:L HH:L")

MISSED = (0.0, 3.0, 6.0)
WIDTH = Rules(MISSED, MISSED, LEVEL.text)
"""In the loop: of the motion that the window in use misses, and that the next wider one would miss
[standard deviations of what noise alone makes of it], to the way that the width goes: wider above
1/2, narrower below. The rules are those of the level, which smooths the more, the less of the
signal is lost by it."""

DOUBT = Rules((3.0, 4.5, 6.0), (0.0, 0.05, 0.15), "LL:L LM:L LH:L ML:L MM:M MH:H HL:H HM:H HH:H")
"""In the loop: of a sample's distance from what is expected [standard deviations], and the share of
impulses of late, to whether it is one: above 1/2. Where impulses are frequent a sample is doubted
sooner."""
