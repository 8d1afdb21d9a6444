"""What keys and mouse do in the window."""

from collections.abc import Callable, Mapping
from typing import Final

from parser.geometry.curves import Floats
from sim.show.draw.layout import Box, centred
from sim.show.draw.silent_pygame import pygame
from sim.show.film.layout import shifted, zoomed
from sim.show.film.playback import Playback
from sim.show.film.screen import Screen
from sim.show.keys import OF_WINDOW, actions_of

_KEYS: Final = actions_of(OF_WINDOW)
_NAMES: Final = {
    pygame.K_LEFT: "ArrowLeft",
    pygame.K_RIGHT: "ArrowRight",
    pygame.K_UP: "ArrowUp",
    pygame.K_DOWN: "ArrowDown",
    pygame.K_PAGEUP: "PageUp",
    pygame.K_PAGEDOWN: "PageDown",
    pygame.K_HOME: "Home",
    pygame.K_END: "End",
    pygame.K_ESCAPE: "Escape",
}
ZOOM: Final = 1.25
CALM: Final = 0.25
"""The view moves when a wire that is followed comes into this share of the plot at a side."""


class Controls:
    """The state of the window beside that of the run.

    Attributes
    ----------
    playback
        The run.
    view
        What the plot shows.
    follows, helps, quits
        Whether the plot follows the wire, whether the keys are shown, and whether the window is to close.
    """

    def __init__(self, playback: Playback, screen: Screen) -> None:
        self.playback = playback
        self.follows = self.helps = self.quits = False
        self._drags = ""
        self._actions = self._meanings()
        self.fit(screen)

    def fit(self, screen: Screen) -> None:
        """Show the whole on a screen, from now on."""
        self._screen, self.view, self.follows = screen, screen.whole, False

    def refit(self, screen: Screen) -> None:
        """Go on with a screen of another size: what was the middle of the plot stays there."""
        was, is_whole = self._screen, self.view == self._screen.whole
        middle = was.layout.plot
        self._screen = screen
        if is_whole:
            self.view = screen.whole
        else:
            place = self.view.range_um(middle).mean(axis=0)
            self.view = centred(place, self.view.px_per_um, screen.layout.plot)

    def handle(self, event: pygame.event.Event) -> None:
        """Do what an event asks for."""
        if event.type == pygame.QUIT:
            self.quits = True
        elif event.type == pygame.KEYDOWN:
            self._actions.get(_KEYS.get(_named(event), ""), lambda: None)()
        elif event.type == pygame.MOUSEWHEEL:
            self._zoom(ZOOM**event.y, pygame.mouse.get_pos())
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
            self._press(event.pos)
        elif event.type == pygame.MOUSEBUTTONUP and event.button == 1:
            self._drags = ""
        elif event.type == pygame.MOUSEMOTION and self._drags:
            self._drag(event.pos, event.rel)

    def follow(self, wire_um: Floats) -> None:
        """Keep the wire in the middle of the plot, if it is to be followed."""
        plot = self._screen.layout.plot
        x, y = self.view.to_px(wire_um).tolist()
        margin_x, margin_y = CALM * (plot.right - plot.left), CALM * (plot.bottom - plot.top)
        calm = Box(plot.left + margin_x, plot.top + margin_y, plot.right - margin_x, plot.bottom - margin_y)
        if self.follows and not calm.holds(Box(x, y, x, y)):
            self.view = centred(wire_um, self.view.px_per_um, plot)

    def _meanings(self) -> Mapping[str, Callable[[], None]]:
        play = self.playback
        return {
            "toggle": play.toggle,
            "stepBack": lambda: play.by_step(False),
            "stepOn": lambda: play.by_step(True),
            "hundredBack": lambda: self._by_hundred(forward=False),
            "hundredOn": lambda: self._by_hundred(forward=True),
            "blockBack": lambda: play.by_block(False),
            "blockOn": lambda: play.by_block(True),
            "toStart": lambda: play.seek(0.0),
            "toEnd": lambda: play.seek(play.course.duration_s),
            "slower": lambda: play.change_speed(False),
            "faster": lambda: play.change_speed(True),
            "zoomIn": lambda: self._zoom(ZOOM, self._middle()),
            "zoomOut": lambda: self._zoom(1.0 / ZOOM, self._middle()),
            "fit": lambda: self.fit(self._screen),
            "follow": self._toggle_follow,
            "help": self._toggle_help,
            "quit": self._quit,
        }

    def _by_hundred(self, *, forward: bool) -> None:
        for _ in range(100):
            self.playback.by_step(forward)

    def _middle(self) -> tuple[int, int]:
        plot = self._screen.layout.plot
        return round((plot.left + plot.right) / 2.0), round((plot.top + plot.bottom) / 2.0)

    def _toggle_follow(self) -> None:
        self.follows = not self.follows

    def _toggle_help(self) -> None:
        self.helps = not self.helps

    def _quit(self) -> None:
        self.quits = True

    def _zoom(self, factor: float, at: tuple[int, int]) -> None:
        self.view = zoomed(self.view, factor, at, self._screen.whole)

    def _press(self, at: tuple[int, int]) -> None:
        if at[1] >= self._screen.layout.strip.top:
            self._drags = "strip"
            self._drag(at, (0, 0))
        elif _holds(self._screen.layout.plot, at):
            self._drags = "plot"

    def _drag(self, at: tuple[int, int], by: tuple[int, int]) -> None:
        if self._drags == "strip":
            strip = self._screen.layout.strip
            share = (at[0] - strip.left) / (strip.right - strip.left)
            self.playback.seek(share * self.playback.course.duration_s)
        else:
            self.view, self.follows = shifted(self.view, by), False


def _named(event: pygame.event.Event) -> str:
    """The key of an event as browsers name it; letters and signs as the keyboard's layout has them."""
    return _NAMES.get(event.key) or str(event.unicode).lower()


def _holds(box: Box, at: tuple[int, int]) -> bool:
    return box.left <= at[0] < box.right and box.top <= at[1] < box.bottom
