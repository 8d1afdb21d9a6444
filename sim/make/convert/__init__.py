"""A program in another language, proved before it is given; what crosses the border is `Converted` or `Refused`."""
