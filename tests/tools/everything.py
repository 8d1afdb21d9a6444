"""One of each thing that a canvas draws."""

import numpy as np

from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import Box
from sim.show.draw.style import Paint


def square(low: float, high: float, by: float = 0.0) -> np.ndarray:
    return np.array([[low, low], [high, low], [high, high], [low, high]]) + by


def everything(canvas: Canvas) -> None:
    canvas.polyline(np.array([[1.0, 2.0], [30.0, 40.0]]), Paint.IDEAL, 2.0)
    canvas.polyline(np.array([[9.0, 9.0]]), Paint.KERF, 6.0)
    canvas.dashed(np.array([[0.0, 50.0], [40.0, 50.0]]), Paint.JUMP, 2.0, 6.0, 4.0)
    canvas.ring(np.array([20.0, 20.0]), 8.0, Paint.START, 2.0)
    canvas.disc(np.array([60.0, 20.0]), 5.0, Paint.ACTUAL)
    canvas.arrow(np.array([70.0, 70.0]), np.array([1.0, 0.0]), 12.0, Paint.IDEAL)
    canvas.polygon(square(80, 95), Paint.CLAMP)
    canvas.region([square(5, 25, 60), square(10, 20, 60)], Paint.SLUG)
    canvas.box(Box(100.0, 10.0, 140.0, 40.0), Paint.WORK, Paint.WORK_EDGE, 2.0)
    with canvas.clipped(Box(100.0, 50.0, 120.0, 60.0)):
        canvas.polygon(square(90, 150), Paint.ERROR)
        canvas.polyline(np.array([[90.0, 55.0], [150.0, 55.0]]), Paint.INK, 3.0)
    canvas.text((100.0, 80.0), 'N1 <script>"&零件', 14.0, Paint.INK, align=0.5)
