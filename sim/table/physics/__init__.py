"""The equations of one axis: motor, drive, and the state of its slide; the border types are `Drive` and `Slide`."""
