"""Sums and conditions of motion programs, as functions of the values that the variables of a card have.

Operators, functions and their order are those of Turbo PMAC (Software Reference Manual, "Mathematical features"):
``* / % &`` before ``+ - | ^``, of equal rank from left to right; in conditions ``AND`` before ``OR``. Power PMAC's
``== <= >= && ||`` are read too.

Values of the variables of a card, as far as a text gives them: what it never sets is not known.
"""

import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple


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


_MOST_NESTED = 32  # parentheses in one another: PMAC takes fewer, and Python's stack many more
_NEAR = 1e-10  # of the greater side: PMAC's own numbers have 36 bits, and end near 1.5e-11

_SPACES = re.compile(r"[ \t]*")
_NUMBER = re.compile(r"\d{1,15}\.?\d*|\.\d+")
_HEX = re.compile(r"\$([0-9A-F]{1,12})", re.IGNORECASE)
_VARIABLE = re.compile(r"([IPQM])[ \t]*(?:(\d{1,5})(?![\d.])|(?=\())", re.IGNORECASE)
_FUNCTION = re.compile(r"(ATAN2|ATAN|ASIN|ACOS|SIN|COS|TAN|SQRT|ABS|EXP|LN|INT)[ \t]*(?=\()", re.IGNORECASE)
_COMPARED = re.compile(r"!=|==|!>|!<|!~|<=|>=|=|>|<|~")
_AND, _OR = re.compile(r"AND(?![A-Z])|&&", re.IGNORECASE), re.compile(r"OR(?![A-Z])|\|\|", re.IGNORECASE)
_PRODUCT, _SUM = re.compile(r"[*/%]|&(?!&)"), re.compile(r"[-+^]|\|(?!\|)")

Operation = Callable[[float, float], float]
Worked = Callable[[Values], float]
"""What an expression is with the values of the variables. UnknownValue where it cannot be worked out."""


class Parsed(NamedTuple):
    """An expression, and the place in the text behind it."""

    worked: Worked
    past: int


class NotAnExpressionError(ValueError):
    """The text there is no expression."""


def parse_sum(text: str, at: int, past: int) -> Parsed:
    """The sum that begins at `at`, up to where none goes on. NotAnExpressionError where none begins there."""
    reader = _Reader(text, at, past)
    return Parsed(reader.sum(), reader.at)


def parse_parenthesised(text: str, at: int, past: int, *, condition: bool = False) -> Parsed:
    """The sum, or the condition, in the parentheses that open at `at`. NotAnExpressionError where there is none.

    A condition is 1 where it holds, else 0.
    """
    reader = _Reader(text, at, past)
    return Parsed(reader.enclosed(condition=condition), reader.at)


class _Reader:
    """Reads by recursive descent; a method a rank."""

    def __init__(self, text: str, at: int, past: int) -> None:
        self.text, self.at, self.past, self.depth = text, at, past, 0

    def enclosed(self, *, condition: bool) -> Worked:
        self.depth += 1
        if self.depth > _MOST_NESTED or self._sign("(") is None:
            raise NotAnExpressionError
        inner = self._either() if condition else self.sum()
        if self._sign(")") is None:
            raise NotAnExpressionError
        self.depth -= 1
        return inner

    def sum(self) -> Worked:
        return self._chain(_SUM, lambda: self._chain(_PRODUCT, self._factor))

    def _chain(self, operator: re.Pattern[str], operand: Callable[[], Worked]) -> Worked:
        first, rest = operand(), list[tuple[Operation, Worked]]()
        while sign := self._match(operator):
            rest.append((_OPERATORS[sign[0]], operand()))
        return _chained(first, tuple(rest)) if rest else first

    def _factor(self) -> Worked:
        if self._sign("-"):
            return combined("-", _constant(0.0), self._signed())
        if self._sign("+"):
            return self._signed()
        if number := self._match(_NUMBER):
            return _constant(float(number[0]))
        if number := self._match(_HEX):
            return _constant(float(int(number[1], 16)))
        return self._named()

    def _signed(self) -> Worked:
        self.depth += 1
        if self.depth > _MOST_NESTED:
            raise NotAnExpressionError
        inner = self._factor()
        self.depth -= 1
        return inner

    def _named(self) -> Worked:
        """A function, a variable, or parentheses."""
        if named := self._match(_FUNCTION):
            return _function(named[1].upper(), self.enclosed(condition=False))
        variable = self._match(_VARIABLE)
        inner = None if variable and variable[2] else self.enclosed(condition=False)
        if variable is None:
            return inner or _constant(0.0)
        letter = variable[1].upper()
        if inner is None:
            name = f"{letter}{int(variable[2])}"
            return lambda values: values.value(name)
        return lambda values: values.value(indexed(letter, inner(values)))

    def _either(self) -> Worked:
        return some(self._joined(_OR, lambda: every(self._joined(_AND, self._compared))))

    def _joined(self, word: re.Pattern[str], condition: Callable[[], Worked]) -> list[Worked]:
        found = [condition()]
        while self._match(word):
            found.append(condition())
        return found

    def _compared(self) -> Worked:
        start, depth = self.at, self.depth
        try:
            left = self.sum()
            if sign := self._match(_COMPARED):
                return _chained(left, ((_COMPARISONS[sign[0]], self.sum()),))
        except NotAnExpressionError:
            pass
        self.at, self.depth = start, depth  # no comparison begins here: a condition in parentheses of its own
        return self.enclosed(condition=True)

    def _match(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        blank = _SPACES.match(self.text, self.at, self.past)
        found = pattern.match(self.text, blank.end() if blank else self.at, self.past)
        if found:
            self.at = found.end()
        return found

    def _sign(self, sign: str) -> bool | None:
        return True if self._match(_SIGNS[sign]) else None


def indexed(letter: str, index: float) -> str:
    """Name of the variable that a letter with a sum behind it is. UnknownValue where the sum is no whole number."""
    if index != int(index) or index < 0.0:
        raise UnknownValue(f"{letter}({index:g})", "no-result")
    return f"{letter}{index:.0f}"


def every(conditions: Sequence[Worked]) -> Worked:
    """A condition that holds where all of some do; each is looked at where those before it hold."""
    if len(conditions) == 1:
        return conditions[0]
    return lambda values: float(all(condition(values) for condition in conditions))


def some(conditions: Sequence[Worked]) -> Worked:
    """A condition that holds where one of some does; each is looked at where none before it holds."""
    if len(conditions) == 1:
        return conditions[0]
    return lambda values: float(any(condition(values) for condition in conditions))


def combined(operator: str, first: Worked, second: Worked) -> Worked:
    """Two sums by an operator of the language, such as ``+``."""
    return _chained(first, ((_OPERATORS[operator], second),))


def _constant(value: float) -> Worked:
    return lambda _: value


def _chained(first: Worked, rest: tuple[tuple[Operation, Worked], ...]) -> Worked:
    """Operations of one rank from left to right; a loop, since a line may hold more of them than Python's stack."""

    def worked(values: Values) -> float:
        result = first(values)
        for operation, operand in rest:
            left, right = result, operand(values)
            try:
                result = operation(left, right)
            except OverflowError:
                result = math.inf
            if not math.isfinite(result):
                raise UnknownValue(f"{left:g}, {right:g}", "no-result")
        return result

    return worked


def _quotient(dividend: float, divisor: float) -> float:
    if divisor == 0.0:
        raise UnknownValue("1/0", "no-result")
    return dividend / divisor


def _remainder(dividend: float, divisor: float) -> float:
    """``%``: from 0 to a positive divisor, from -n to n for a divisor of -n."""
    if divisor == 0.0:
        raise UnknownValue("1/0", "no-result")
    if divisor > 0.0:
        return dividend - divisor * math.floor(dividend / divisor)
    span = -2.0 * divisor
    return dividend - divisor - span * math.floor((dividend - divisor) / span) + divisor


def _bits(operation: Callable[[int, int], int]) -> Operation:
    def worked(left: float, right: float) -> float:
        if left != int(left) or right != int(right):
            raise UnknownValue(f"{left:g} & {right:g}", "no-result")
        return float(operation(int(left), int(right)))

    return worked


def _compare(decided: Callable[[float, float], bool]) -> Operation:
    """A comparison; sides that differ by less than the card's own digits are compared by the card alone."""

    def worked(left: float, right: float) -> float:
        if left != right and abs(left - right) < _NEAR * max(abs(left), abs(right)):
            raise UnknownValue(f"{left:.12g} = {right:.12g}", "too-near")
        return float(decided(left, right))

    return worked


def _function(name: str, inner: Worked) -> Worked:
    turned = name in {"SIN", "COS", "TAN"}
    turning = name in {"ASIN", "ACOS", "ATAN", "ATAN2"}

    def worked(values: Values) -> float:
        value = inner(values)
        unit = math.pi / 180.0 if values.degrees else 1.0
        try:
            if name == "ATAN2":
                return math.atan2(value, values.value("Q0")) / unit
            result = _FUNCTIONS[name](value * unit if turned else value)
        except (ValueError, OverflowError):
            raise UnknownValue(f"{name}({value:g})", "no-result") from None
        return result / unit if turning else result

    return worked


_SIGNS: Mapping[str, re.Pattern[str]] = {sign: re.compile(re.escape(sign)) for sign in "()+-"}
_OPERATORS: Mapping[str, Operation] = {
    "+": lambda left, right: left + right,
    "-": lambda left, right: left - right,
    "*": lambda left, right: left * right,
    "/": _quotient,
    "%": _remainder,
    "&": _bits(lambda left, right: left & right),
    "|": _bits(lambda left, right: left | right),
    "^": _bits(lambda left, right: left ^ right),
}
_COMPARISONS: Mapping[str, Operation] = {
    "=": _compare(lambda left, right: left == right),
    "==": _compare(lambda left, right: left == right),
    "!=": _compare(lambda left, right: left != right),
    ">": _compare(lambda left, right: left > right),
    "!>": _compare(lambda left, right: left <= right),
    "<=": _compare(lambda left, right: left <= right),
    "<": _compare(lambda left, right: left < right),
    "!<": _compare(lambda left, right: left >= right),
    ">=": _compare(lambda left, right: left >= right),
    "~": lambda left, right: float(abs(left - right) < 1.0),
    "!~": lambda left, right: float(abs(left - right) >= 1.0),
}
_FUNCTIONS: Mapping[str, Callable[[float], float]] = {
    "SIN": math.sin,
    "COS": math.cos,
    "TAN": math.tan,
    "ASIN": math.asin,
    "ACOS": math.acos,
    "ATAN": math.atan,
    "SQRT": math.sqrt,
    "ABS": abs,
    "EXP": math.exp,
    "LN": math.log,
    "INT": math.floor,
}
