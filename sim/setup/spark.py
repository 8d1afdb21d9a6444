"""Sparks of a machine or scenario, and what happens in the cut: ``[spark]`` and ``[[event]]``."""

from collections.abc import Mapping
from typing import Any, Final, Literal, NamedTuple, get_args

from parser.findings.errors import SettingsError
from parser.units import mm
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import MM_AS_UM, MM_MIN_AS_UM_S, Number, OneOf, Truth, Whole
from sim.setup.toml.reader import Bound, tables

Mode = Literal["I1", "I5", "I9", "I13", "I15", "I17"]
Law = Literal["voltage", "window", "duty"]
Threading = Literal["place", "start", "reverse"]
EventKind = Literal[
    "short", "chips", "break", "power", "pause", "sparks-off", "pump-off", "drum-off", "set", "single", "skip", "origin"
]

_FEED_MM_MIN: Final = Bound(0.01, 1e4)
_SECONDS: Final = Bound(0.0, 1e5)
MOST_EVENTS: Final = 1000
SEED: Final = Bound(0, 2**31 - 1)
_SET_SHARE: Final = Bound(0.01, 0.99)


class LawValues(NamedTuple):
    """What a law goes by, where its file says nothing else.

    Attributes
    ----------
    set_value
        What it holds: of the mean voltage over the open one, of the share of the open gap, of the sparks that could
        have come.
    gain_um_s, reset_s
        Speed for an error of all, and time in which a lasting one adds as much; the law by the last millisecond goes by
        neither.
    least_um_s, most_um_s
        Slowest and fastest feed; laws that can go back have no slowest one.
    """

    set_value: float
    gain_um_s: float
    reset_s: float
    least_um_s: float
    most_um_s: float


PRESETS: Final[Mapping[str, LawValues]] = {
    "voltage": LawValues(0.4, 1000.0, 0.2, 0.0, 300.0),
    "window": LawValues(0.5, 1000.0, 0.2, 0.0, 1000.0),
    "duty": LawValues(0.75, 300.0, 1.0, 100.0, 2000.0),
}
"""By mean voltage: gains of ours. By the last millisecond: Spark-corefw, ``motion.c``, 1 µm on and 5 µm back. By sparks
that came: ``powercore.py`` of danger-klipper, target 0.75, 6 to 120 mm/min; gains of ours."""


class Spark(NamedTuple):
    """Sparks and the control that follows them.

    Attributes
    ----------
    mode
        Energy of the sparks, by which they make their craters.
    on_us, off_us
        How long a spark lasts, and the pause behind it.
    open_v
        Voltage of the open gap, V.
    law
        What the control goes by: mean voltage, the last millisecond, or the share of sparks that came.
    set_value, gain_um_s, reset_s, least_um_s, most_um_s
        As `LawValues` has them; those of `PRESETS` where None.
    back_um_s
        Fastest way back.
    ring_um
        The farthest that the control goes back.
    short_s
        After a short of this length it stops.
    most_mm2_min
        Area rate at which the wire breaks; nobody knows it where None.
    thread_s, restart_s, jog_um_s
        Time to thread the wire anew, to go on after a power loss, and the speed through the slot without sparks.
    threading
        Where a broken wire is threaded.
    breaks_per_h
        How often it breaks without any reason that the model knows, in an hour of cutting.
    seed
        Of all that is random.
    """

    mode: Mode = "I17"
    on_us: float = 3.0
    off_us: float = 80.0
    open_v: float = 80.0
    law: Law = "voltage"
    set_value: float | None = None
    gain_um_s: float | None = None
    reset_s: float | None = None
    least_um_s: float | None = None
    most_um_s: float | None = None
    back_um_s: float = 300.0
    ring_um: float = 1000.0
    short_s: float = 3.0
    most_mm2_min: float | None = None
    thread_s: float = 180.0
    restart_s: float = 300.0
    jog_um_s: float = 5000.0
    threading: Threading = "start"
    breaks_per_h: float = 0.0
    seed: int = 1

    @property
    def filled(self) -> LawValues:
        """What its law goes by, those values that nobody gave taken from its preset."""
        own = {name: value for name in LawValues._fields if (value := getattr(self, name)) is not None}
        return PRESETS[self.law]._replace(**own)


class Event(NamedTuple):
    """Something that happens in the cut, at a block or at a time.

    Attributes
    ----------
    kind
        What.
    block
        In which block, from 1, as far along as `share` says; None where it comes at a time or at random.
    share
        How far along the block, from 0 to 1.
    at_s
        When; None where it comes at a block or at random.
    per_h
        How often in an hour of cutting, where it comes at random; else None.
    for_s
        How long it lasts.
    clear_um
        Of a short: the way back that clears it.
    factor
        Of chips: by how much the area rate is less at which the wire breaks.
    remembers
        Of a power loss: whether the control goes on at its step; else the block is begun again.
    set_value
        Of the knob: what it is set to.
    seed
        Of what comes at random; by that of the cut where None.
    """

    kind: EventKind
    block: int | None = None
    share: float = 0.0
    at_s: float | None = None
    per_h: float | None = None
    for_s: float = 1.0
    clear_um: float = 50.0
    factor: float = 0.5
    remembers: bool = True
    set_value: float | None = None
    seed: int | None = None


_US = Number(Bound(0.1, 1e4), "µs")
SPARK = Section(
    "spark",
    (
        Key("mode", OneOf(get_args(Mode)), default=Spark().mode),
        Key("on_us", _US, default=Spark().on_us),
        Key("off_us", _US, default=Spark().off_us),
        Key("open_v", Number(Bound(1.0, 1000.0), "V"), default=Spark().open_v),
        Key("law", OneOf(get_args(Law)), default=Spark().law),
        Key("set_value", Number(_SET_SHARE), default=None),
        Key("gain_mm_s", Number(Bound(0.001, 100.0), "mm/s", MM_AS_UM), "gain_um_s", None),
        Key("reset_s", Number(Bound(0.01, 100.0), "s"), default=None),
        Key("least_feed_mm_min", Number(_FEED_MM_MIN, "mm/min", MM_MIN_AS_UM_S), "least_um_s", None),
        Key("most_feed_mm_min", Number(_FEED_MM_MIN, "mm/min", MM_MIN_AS_UM_S), "most_um_s", None),
        Key("back_feed_mm_min", Number(_FEED_MM_MIN, "mm/min", MM_MIN_AS_UM_S), "back_um_s", 18.0),
        Key("ring_mm", Number(Bound(0.01, 1000.0), "mm", MM_AS_UM), "ring_um", mm(Spark().ring_um)),
        Key("short_s", Number(Bound(0.02, 600.0), "s"), default=Spark().short_s),
        Key("most_mm2_min", Number(Bound(0.1, 1e4), "mm²/min"), default=None),
        Key("thread_s", Number(_SECONDS, "s"), default=Spark().thread_s),
        Key("restart_s", Number(_SECONDS, "s"), default=Spark().restart_s),
        Key("jog_feed_mm_min", Number(_FEED_MM_MIN, "mm/min", MM_MIN_AS_UM_S), "jog_um_s", 300.0),
        Key("threading", OneOf(get_args(Threading)), default=Spark().threading),
        Key("breaks_per_h", Number(Bound(0.0, 100.0), "/h"), default=Spark().breaks_per_h),
        Key("seed", Whole(SEED), default=Spark().seed),
    ),
    fills="spark",
)
EVENT = Section(
    "event",
    (
        Key("kind", OneOf(get_args(EventKind))),
        Key("block", Whole(Bound(1, 1e7)), default=None),
        Key("share", Number(Bound(0.0, 1.0)), default=Event("short").share),
        Key("at_s", Number(Bound(0.0, 1e7), "s"), default=None),
        Key("per_h", Number(Bound(0.001, 1000.0), "/h"), default=None),
        Key("seed", Whole(SEED), default=None),
        Key("for_s", Number(_SECONDS, "s"), default=Event("short").for_s),
        Key("clear_mm", Number(Bound(0.001, 1000.0), "mm", MM_AS_UM), "clear_um", mm(Event("short").clear_um)),
        Key("factor", Number(Bound(0.0, 1.0)), default=Event("short").factor),
        Key("remembers", Truth(), default=Event("short").remembers),
        Key("set_value", Number(_SET_SHARE), default=None),
    ),
    fills="events",
    form="list",
)


def read_spark(content: Mapping[str, Any], where: str) -> Spark | None:
    """Sparks of a machine or scenario file; None without ``[spark]``. SettingsError names file and key."""
    return Spark(**SPARK.read_in(content, where)) if SPARK.name in content else None


def read_events(content: Mapping[str, Any], where: str) -> tuple[Event, ...]:
    """Tables ``[[event]]`` of a scenario. SettingsError names file, event and key, and what does not go together."""
    found = tables(content, EVENT.name, where)
    if len(found) > MOST_EVENTS:
        raise SettingsError("too-many-events", where=where, found=len(found), most=MOST_EVENTS)
    return tuple(_event(table, f"{where}: {EVENT.header} {at}") for at, table in enumerate(found, start=1))


def _event(table: Mapping[str, Any], where: str) -> Event:
    event = Event(**EVENT.read(table, where))
    if sum(given is not None for given in (event.block, event.at_s, event.per_h)) != 1:
        raise SettingsError("event-needs-one-place", where=where)
    if (event.kind == "set") != (event.set_value is not None):
        raise SettingsError("event-set-value", where=where)
    if event.seed is not None and event.per_h is None:
        raise SettingsError("event-seed-without-rate", where=where)
    return event
