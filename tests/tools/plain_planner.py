"""The plain planner: the fastest speeds along rows, one row at a time, from the equations of motion alone.

It walks forward at full acceleration; where a limit ahead can no longer be kept, it goes back, row by row, and slows
what it had allowed.
"""

from math import sqrt

from controller.motion.planner import RowLimits


def plain_border_speeds(limits: RowLimits, from_um_s: float | None = None) -> list[float]:
    length, cap, a, border = (column.tolist() for column in limits[:4])
    n = len(length)
    most = [min([border[i], *cap[max(i - 1, 0) : i + 1]]) for i in range(n + 1)]
    if from_um_s is not None:
        most[0] = from_um_s
    speed = [most[0]]
    while len(speed) <= n:
        row = len(speed) - 1
        speed.append(min(most[row + 1], sqrt(speed[row] ** 2 + 2 * a[row] * length[row])))
        while row >= 0 and speed[row] > sqrt(speed[row + 1] ** 2 + 2 * a[row] * length[row]):
            speed[row] = sqrt(speed[row + 1] ** 2 + 2 * a[row] * length[row])
            row -= 1
    return speed


def plain_row_time(length: float, cap: float, a: float, first: float, last: float) -> float:
    """Time of a row: up to its peak, along at its cap, down from its peak."""
    if length == 0:
        return 0.0
    peak = min(cap, sqrt(first**2 / 2 + last**2 / 2 + a * length))
    peak = max(peak, first, last)
    along = length - (peak - first) * (peak + first) / (2 * a) - (peak - last) * (peak + last) / (2 * a)
    return (peak - first) / a + max(along, 0.0) / peak + (peak - last) / a


def plain_duration(limits: RowLimits, from_um_s: float | None = None) -> float:
    speed = plain_border_speeds(limits, from_um_s)
    rows = zip(*(column.tolist() for column in limits[:3]), speed[:-1], speed[1:], strict=True)
    return sum(plain_row_time(*row) for row in rows) + sum(limits.wait_s.tolist())
