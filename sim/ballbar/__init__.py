"""The circular test of ISO 230-4: a circle run both ways, its figures, what caused them, and the polar plot."""
