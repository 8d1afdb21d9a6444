"""Units of the card's calls in those of the inside; one pulse is 1 µm, and the card counts in ms (grade A)."""

UM_S_PER_PULSE_MS = 1e3
UM_S2_PER_PULSE_MS2 = 1e6
UM_S3_PER_PULSE_MS3 = 1e9
