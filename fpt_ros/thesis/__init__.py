"""The claims of the thesis, one a block, and the page that judges them."""
