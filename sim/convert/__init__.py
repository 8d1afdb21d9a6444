"""A program in another language, proved before it is given: `Program` and `Wanted` in, `Converted` or `Refused` out."""
