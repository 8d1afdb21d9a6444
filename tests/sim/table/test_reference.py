"""Ticks in pymunk come to what the events are, the finer they are; and both end where slow steps leave a slide."""

import numpy as np
import pytest
from depth import DEEP
from table_runs import CENTRE, MODEL, draw, even_ticks, motion, moved, pulses_of

from controller.motion.limits import Feeds
from controller.stepping.pulses import Pulses
from sim.setup.machine.machine import load_machine
from sim.setup.machine.motor import Motor
from sim.setup.machine.table import TableModel
from sim.table.motion import Moved
from sim.table.ticks import (
    SHAKEN_RAD,
    STEP_RAD,
    STEPS_RAD,
    Ticks,
    rhythm,
)

FINER = 16.0
"""So many times as fine as a run in pymunk would choose are the ticks here."""
WITHIN_UM = 0.01
NEAR_A_STOP = (150.0, 250_000.0)


def finer(ticks: Ticks, times: float = FINER) -> Ticks:
    """Samples of a run, in finer ticks."""
    names = ("step_tick_s", "steps_tick_s", "shaken_tick_s")
    return ticks._replace(**{name: tuple(tick_s / times for tick_s in getattr(ticks, name)) for name in names})


def ticks_of(model: TableModel, until_s: float) -> Ticks:
    """The ticks that a run would choose, with a shake in their midst, and a sample every 2 ms."""
    beats = rhythm(model)
    phases = {"step_tick_s": STEP_RAD, "steps_tick_s": STEPS_RAD, "shaken_tick_s": SHAKEN_RAD}
    chosen = {name: beats.tick_s(phase) for name, phase in phases.items()}
    return even_ticks(until_s, 2e-3)._replace(shaken_s=np.array([[0.05, 0.08]]), **chosen)


def random_model(rng: np.random.Generator) -> TableModel:
    """Any table: masses, stiffness, damping, friction and slack or none, steppers that slip and servos that trip."""
    servo = rng.random() < 0.3
    curve = ((0.0, 10.0 ** rng.uniform(1.7, 4.0)), (2000.0, 10.0 ** rng.uniform(1.5, 3.5)))
    motor = Motor(
        kind="servo" if servo else "stepper",
        # A motor that jumps has no speed in a tick: the damper's part of it would hang on the tick.
        step_time_s=float(rng.choice([5e-4, 1e-3, 2e-3, 5e-3])),
        electrical_period_um=6.0,
        following_error_limit_um=rng.uniform(5.0, 60.0) if servo else np.inf,
        force_curve=curve,
    )
    pairs = {
        "friction_n": [0.0, 5.0, 20.0, 60.0],
        "viscous_n_s_mm": [0.0, 2.0, 8.0],
        "backlash_um": [0.0, 0.5, 3.0],
    }
    return MODEL._replace(
        saddle_mass_kg=rng.uniform(5.0, 300.0),
        carriage_mass_kg=rng.uniform(5.0, 200.0),
        drive_stiffness_n_um=10.0 ** rng.uniform(0.3, 2.0),
        drive_damping_ratio=rng.uniform(0.05, 1.5),
        motor=motor,
        **{name: tuple(rng.choice(values, 2).tolist()) for name, values in pairs.items()},
    )


def random_waves(rng: np.random.Generator, until_s: float) -> Pulses:
    sizes, rates = rng.uniform(10.0, 600.0, 2), rng.uniform(5.0, 40.0, 2)
    ways = [lambda t, a=a, w=w: a * np.sin(w * t) for a, w in zip(sizes, rates, strict=True)]
    return pulses_of(*ways, until_s, 1e-5)


def assert_alike(compiled: Moved, reference: Moved, within_um: float = WITHIN_UM) -> None:
    assert compiled.trace.table_um == pytest.approx(reference.trace.table_um, abs=within_um)
    assert [loss[:3] for loss in compiled.losses] == [loss[:3] for loss in reference.losses]
    for one, other in zip(compiled.losses, reference.losses, strict=True):
        within = 1e-9 if one.kind == "lost-steps" else 0.1  # a tick sees a trip once it has passed
        assert one.amount_um == pytest.approx(other.amount_um, abs=within)
        assert one.t_s == pytest.approx(other.t_s, abs=1e-3)


def assert_history_alike(compiled: Moved, reference: Moved) -> None:
    """Where a force jumps within a tick, that tick's share of a bin is another one: it is the means that are held."""
    ours, theirs = compiled.history, reference.history
    for one, other in zip(ours.velocity_um_s, theirs.velocity_um_s, strict=True):
        assert one == pytest.approx(other, abs=0.01 * np.abs(ours.velocity_um_s.high).max())
    for one, other in zip(ours.lag_um, theirs.lag_um, strict=True):
        assert one == pytest.approx(other, abs=0.02)
    assert ours.following_error_um.mean == pytest.approx(theirs.following_error_um.mean, abs=0.05)
    for name in ("force_n", "acceleration_um_s2"):
        mean, other = getattr(ours, name).mean, getattr(theirs, name).mean
        assert mean == pytest.approx(other, abs=0.01 * max(np.abs(getattr(ours, name).high).max(), 1.0)), name


@pytest.mark.deeper
def test_random_tables_move_as_in_pymunk_the_finer_its_ticks_and_lose_the_same() -> None:
    kinds, nearer = set(), 0
    for seed in range(12):
        rng = np.random.default_rng(seed)
        model, pulses, start_um = random_model(rng), random_waves(rng, 0.1), CENTRE if seed % 3 else NEAR_A_STOP
        ticks = ticks_of(model, 0.11)
        ours = draw(model, pulses, ticks, start_um)
        coarse, fine = (draw(model, pulses, finer(ticks, times), start_um, "pymunk") for times in (1.0, FINER))
        assert_alike(ours.moved, fine.moved, 3.0)
        coarse_um, fine_um = (np.abs(other.at_um - ours.at_um).max() for other in (coarse, fine))
        nearer += int(fine_um < max(coarse_um / 2.0, WITHIN_UM))
        kinds |= {loss.kind for loss in ours.moved.losses}
    assert kinds == {"lost-steps", "trip"}
    assert nearer >= 10, "but for slides that coast without friction between their flanks"


SHORT = "B12B4B12GXL1 B7B13B13GYL2 B6B0B24GYNR1 DD"
LONG = "B37B11B37GXL1 B23B44B44GYL2 B20B0B80GYNR1 DD"


@pytest.mark.alike(1)
@pytest.mark.parametrize(
    ("name", "feed_um_s"),
    [
        ("dk7750", 500.0),
        ("dk7732", 180.0),
        ("dk7740", 43.75),
        ("servo-400x500", 10_000.0),
    ],  # the quickest stepper first
)
def test_shipped_machines_move_as_in_pymunk(name: str, feed_um_s: float) -> None:
    text, machine = LONG if DEEP else SHORT, load_machine(name)
    runs = [
        motion(text, machine._replace(engine=engine), Feeds(feed_um_s, feed_um_s)) for engine in ("compiled", "pymunk")
    ]
    compiled, reference = (moved(run._replace(ticks=finer(run.ticks))) for run in runs)
    assert_alike(compiled, reference)
    assert_history_alike(compiled, reference)


@pytest.mark.parametrize("engine", ["compiled", "pymunk"])
def test_a_slow_step_leaves_a_slide_where_backlash_and_friction_hold_it(engine: str) -> None:
    """Too slow for any mass to be felt, a slide stays behind by half the backlash and F/k: 1.5 + 1.5, 1.0 + 1.0 µm."""
    even = MODEL.motor._replace(step_time_s=0.2)
    held = MODEL._replace(friction_n=(30.0, 20.0), backlash_um=(3.0, 2.0), drive_damping_ratio=1.0, motor=even)
    steps = np.arange(1, 9, dtype=np.int32)
    pulses = Pulses(0.3 * steps, steps, steps, np.zeros_like(steps))
    drawn = draw(held, pulses, even_ticks(3.0, 2e-3), engine=engine)
    assert 8.0 - drawn.at_um[-1] == pytest.approx([3.0, 2.0], abs=0.05)  # µm
    assert not drawn.at_um[drawn.t_s < 0.6].any()


@pytest.mark.parametrize("engine", ["compiled", "pymunk"])
def test_between_steps_a_slide_that_rests_needs_no_ticks(engine: str) -> None:
    held = MODEL._replace(friction_n=(30.0, 20.0), drive_damping_ratio=0.7)
    step = np.ones(1, dtype=np.int32)
    short, long = (
        draw(
            held, Pulses(np.array([at_s]), step, step, np.zeros_like(step)), even_ticks(at_s + 0.5, 0.01), engine=engine
        )
        for at_s in (0.1, 3000.1)
    )
    assert long.at_um[-1] == pytest.approx(short.at_um[-1], abs=1e-6)
    assert long.moved.history.t_s[-1] == pytest.approx(3000.6)
