"""Values of the variables of a card, as far as a text gives them: what it never sets is not known."""

import math


class UnknownValue(Exception):  # noqa: N818 - no fault: the text does not say what the card works out there
    """A sum that the text alone does not give.

    Attributes
    ----------
    what
        The variable or the operation at which it stops, as people write it.
    why
        Term of the catalogue that says why, behind ``pmac-``: ``no-value``, ``no-result`` or ``too-near``.
    """

    def __init__(self, what: str, why: str = "no-value") -> None:
        super().__init__(what)
        self.what, self.why = what, why


class Values:
    """Values of I, P, Q and M variables by their names, such as ``P10``.

    M variables are places of the card's memory and its inputs and outputs: what is read there need not be what was
    written. Those that are defined as plain variables (``M5->*``) alone are known.

    Attributes
    ----------
    degrees
        Whether angles are in degrees, as at the start (I15 = 0).
    changes
        How often a value became another.
    """

    def __init__(self, *, degrees: bool = True) -> None:
        self._known: dict[str, float] = {}
        self._plain = set[str]()
        self.degrees = degrees
        self.changes = 0

    def value(self, name: str) -> float:
        """Value of a variable. UnknownValue where nothing in the text gives it one."""
        known = self._known.get(name, math.nan)
        if math.isnan(known) or (name[0] == "M" and name not in self._plain):
            raise UnknownValue(name)
        return known

    def of(self, letter: str) -> dict[str, float]:
        """The known values of the variables of a letter, by their names."""
        return {name: value for name, value in self._known.items() if name[0] == letter}

    def define_plain(self, name: str) -> None:
        """An M variable that is defined as a plain one."""
        self._plain.add(name)

    def set(self, name: str, value: float) -> None:
        """Gives a variable a value."""
        self.changes += self._known.get(name) != value
        self._known[name] = value
        if name == "I15":
            self.degrees = value == 0.0

    def forget(self, name: str) -> None:
        """From here on nobody knows the value of a variable."""
        self.changes += self._known.pop(name, None) is not None

    def forget_all(self, letter: str) -> None:
        """From here on nobody knows the values of the variables of a letter: one of them changed, which is not said."""
        for name in [name for name in self._known if name[0] == letter]:
            self.forget(name)
