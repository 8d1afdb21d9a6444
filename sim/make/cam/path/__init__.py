"""The plan of a cut as what is written: curves, jumps and stops; the border type is `Draft`."""
