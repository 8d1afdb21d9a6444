"""The cut edge beside the drawing: how far they lie apart, both ways, after the one is laid on the other."""
