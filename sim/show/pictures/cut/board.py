"""What marks and labels are put on: a canvas with its layout, its free room and its language."""

from typing import NamedTuple

from sim.show.draw.canvas import Canvas
from sim.show.draw.labels import Room
from sim.show.draw.layout import Page
from sim.show.words import Words


class Board(NamedTuple):
    """A page that is being drawn; what finds its place takes it out of `room`."""

    canvas: Canvas
    page: Page
    room: Room
    say: Words
