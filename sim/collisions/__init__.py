"""What the wire and its arm run into, and where a cut leaves the work: geometry of outlines and a trace, in pymunk."""
