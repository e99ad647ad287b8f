"""For which gain the iteration contracts (thesis, section 3.3): what ``fpt gain`` shows."""
