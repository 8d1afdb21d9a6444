"""Programs for a wire that leans: by one angle, or between two drawings; and the proof of their walls.

A `CutPlan` goes in, the draft of its contours and what is off at each height come out.
"""
