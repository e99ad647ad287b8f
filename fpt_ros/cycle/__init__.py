"""The control cycle: the five stages, and the loop that joins them."""
