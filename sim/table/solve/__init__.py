"""The table over a whole run: its motion solved for many time slices side by side; what crosses the border is `Lanes`.

The motion of a table is an initial value problem: the state after a tick follows from the state before it. A run has
millions of ticks, and one after the other they would take minutes. So the run is solved parallel in time, by multiple
shooting (J.-L. Lions, Y. Maday, G. Turinici, "Résolution d'EDP par un schéma en temps « pararéel »", C. R. Acad. Sci.
Paris 332, 2001; J. Nievergelt, "Parallel methods for integrating ordinary differential equations", Comm. ACM 7, 1964):

slab
    Some hundred thousand ticks in a row, with what the drives are asked for in each. Slabs follow one another, so
    memory does not grow with the run.
lane
    A time slice of a slab, of some 250 ticks. All lanes of a slab run side by side, each on a table of its own.
guess
    The state that a lane begins with before the lane ahead of it has been run: slides where slow motors leave them.
pass
    One run of the lanes that began wrong, each now from the state in which the lane ahead ended: a correction.
agreed
    The matching condition: each lane began where the lane ahead of it ended, within 0.01 µm. Then the passes end.
slow step
    A step that comes after the last has died. What it does to a slide depends on nothing but the lag before it; so it
    is tried once from many lags (`trial`), and kept as a table from lag to lag, a return map (`slow_step`).
march
    The integration itself: ticks one after the other, the tables of all lanes at once, each tick one leapfrog kick.

Two or three passes are enough as a rule, since a table forgets: its ringing is gone after a few milliseconds, and what
friction holds is settled by the next steps. Lost steps go on from lane to lane; they are shifted through lanes that run
far from the stops, and otherwise the lanes run again in order.
"""
