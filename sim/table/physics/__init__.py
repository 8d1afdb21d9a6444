"""The equations of one axis: motor, drive, and the slide as a body in pymunk; the border type is `State`."""
