"""Colours of pictures in a page: those of the other theme, by the classes that they bear."""

from markupsafe import Markup

from sim.show.draw.paints import Theme, hexadecimal


def recoloured(theme: Theme) -> Markup:
    """Rules of a style sheet that show pictures in the colours of a theme."""
    rule = Markup(".f-{0}{{fill:{1}}}.s-{0}{{stroke:{1}}}")
    return Markup("\n").join(rule.format(paint, hexadecimal(colour)) for paint, colour in theme.items())
