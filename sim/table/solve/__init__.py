"""The axes of the table over a whole run, tick by tick; what crosses the border is `AxisRun`.

The motion of a slide is an initial value problem: its state after a tick follows from its state before it. So one
compiled loop, `tick.followed`, goes through the ticks of an axis one after the other. Slides stand between slow steps,
and from one step to the next there are no ticks.

The axes do not pull at one another: the X drive moves saddle and carriage, the Y drive the carriage. So each has ticks
of its own, and goes through a stretch of pulses by itself. Only a servo that trips stops both.
"""
