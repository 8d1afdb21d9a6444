"""The cut edge laid on the drawing: how far they lie apart, both ways; the border type is `Comparison`."""
