"""The equations of one axis: motor, drive, and the body of the slide in pymunk."""
