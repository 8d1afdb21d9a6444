"""Ways that cross themselves and each other, so that pieces hang on pieces: a lattice, a flower, squares, walks."""

import math

import numpy as np
from paths import Pen

from parser.toolpath import Toolpath


def lattice(lines: int) -> Toolpath:
    """To and fro, then up and down across that: the first line across frees whole rows, which later ones part."""
    pen, size = Pen(0, 0), 1000.0 * lines
    for row in range(lines + 1):
        pen.to(size if row % 2 == 0 else 0, 1000.0 * row)
        if row < lines:
            pen.to(pen.x, 1000.0 * (row + 1))
    pen.to(pen.x, size + 600)
    toward = 1.0 if pen.x == 0 else -1.0
    for column in range(lines):
        pen.to(pen.x + toward * (500 if column == 0 else 1000), pen.y)
        pen.to(pen.x, -600 if column % 2 == 0 else size + 600)
    return pen.path()


def flower() -> Toolpath:
    """Loops that each cross the one before."""
    pen = Pen(0, 0)
    for step in range(1, 160):
        angle = step * math.pi / 20
        pen.to(step * 25 + 900 * math.sin(angle), 900 * (1 - math.cos(angle)))
    return pen.path()


def loops(seed: int) -> Toolpath:
    """Squares at random places: some lie in others, some cross others, some lie alone in the frame."""
    rng = np.random.default_rng(seed)
    pen = Pen(0, 0)
    for _ in range(9):
        x, y = rng.integers(0, 24, 2) * 400.0
        size = 500.0 + 300.0 * rng.integers(0, 8)
        pen.jump(x, y)
        for corner in ((x + size, y), (x + size, y + size), (x, y + size), (x, y)):
            pen.to(*corner)
    return pen.path()


def walk(seed: int) -> Toolpath:
    """Lines and arcs from place to place at random, in up to three contours."""
    rng = np.random.default_rng(seed)
    pen = Pen(0, 0)
    for contour in range(int(rng.integers(1, 4))):
        if contour:
            pen.jump(*(100.0 * rng.integers(-30, 31, 2)))
        for _ in range(int(rng.integers(3, 14))):
            if rng.random() < 0.25:
                radius, angle = 100.0 * rng.integers(3, 12), rng.uniform(0.0, 2.0 * math.pi)
                sweep = rng.choice([-1.0, 1.0]) * rng.uniform(1.0, 6.0)
                pen.arc(pen.x + radius * math.cos(angle), pen.y + radius * math.sin(angle), sweep)
            else:
                pen.to(*(100.0 * rng.integers(-30, 31, 2)))
    return pen.path()
