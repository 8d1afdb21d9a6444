"""The pieces that a kerf leaves: which come free, where and when; what crosses the border is `Pieces`."""
