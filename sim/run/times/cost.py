"""What a time costs: each item to the cent, and the sum of these."""

from collections.abc import Iterable
from decimal import ROUND_HALF_UP, Decimal
from typing import Final, NamedTuple

from sim.setup.shop import Rates

_CENT: Final = Decimal("0.01")


class Item(NamedTuple):
    """A part of a cost: the name of its text for people, ``time.cost-…``, and its amount."""

    name: str
    amount: Decimal


class Cost(NamedTuple):
    """What a program costs: the items of its middle time, and the sums of its least and its most."""

    currency: str
    items: tuple[Item, ...]
    least: Decimal
    most: Decimal

    @property
    def total(self) -> Decimal:
        """The sum of the items, to the cent."""
        return _sum(self.items)


def _sum(items: Iterable[Item]) -> Decimal:
    return sum((item.amount for item in items), Decimal("0.00"))


def cost_of(least_min: float, middle_min: float, most_min: float, rates: Rates, programs: int = 1) -> Cost:
    """What between `least_min` and `most_min` cost, and the middle, with so many set-ups."""
    least, middle, most = (tuple(_items(minutes, rates, programs)) for minutes in (least_min, middle_min, most_min))
    return Cost(rates.currency, middle, _sum(least), _sum(most))


def _items(minutes: float, rates: Rates, programs: int) -> list[Item]:
    """The items that cost something."""
    hours = minutes / 60.0
    amounts = {
        "hours": hours * rates.per_hour,
        "wire": minutes * rates.wire_m_min * rates.wire_per_m + hours / rates.wire_life_h * rates.wire_price,
        "power": hours * rates.power_kw * rates.per_kwh,
        "set-up": programs * rates.set_up,
    }
    cents = {name: Decimal(repr(amount)).quantize(_CENT, ROUND_HALF_UP) for name, amount in amounts.items()}
    return [Item(name, amount) for name, amount in cents.items() if amount]
