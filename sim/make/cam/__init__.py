"""A program made of a drawing, proved by a run before it is given; the border types are `MadeProgram` and `NotMade`."""
