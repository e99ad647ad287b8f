"""Denoising: causal filters for the loop (:mod:`fpt_ros.denoising.streaming`)."""
