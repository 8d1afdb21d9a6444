"""The window that plays a run."""

import os
import sys
import time
from typing import Final

from parser.findings.errors import SettingsError
from sim.run.course import Course
from sim.show.draw.paints import THEMES
from sim.show.draw.silent_pygame import pygame
from sim.show.film.controls import Controls
from sim.show.film.help import draw_help
from sim.show.film.plate import Pixels
from sim.show.film.playback import Playback
from sim.show.film.screen import Look, Screen

FPS: Final = 60
LEAST_PX: Final = (480, 320)
CALM_S: Final = 0.12
"""The plot is drawn anew once its view has not changed for so long."""
STALE_S: Final = 0.6
"""While the view goes on changing, the plot is drawn anew this often."""
NO_DISPLAY: Final = "no display: write a film with -o cut.mp4, or open replay.html of drycut run"

_UNSEEN: Final = ("dummy", "offscreen", "evdev")
"""Drivers without a display: SDL takes one where the display that is named does not answer."""


def open_display() -> None:
    """Get ready to show windows. SettingsError where there is no display."""
    try:
        if not _may_have_display():
            raise SettingsError("no-display")
        pygame.display.init()
        if pygame.display.get_driver() in _UNSEEN and not os.environ.get("SDL_VIDEODRIVER"):
            pygame.display.quit()
            raise SettingsError("no-display")
    except pygame.error:
        raise SettingsError("no-display") from None


def _may_have_display() -> bool:
    """Whether it is worth asking: without a display SDL would draw where nobody sees it."""
    servers = ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER")
    return sys.platform != "linux" or any(os.environ.get(name) for name in servers)


class Window:
    """A window that plays a run from its begin."""

    def __init__(self, course: Course, look: Look, speed: float) -> None:
        self._course, self._look = course, look
        self._surface = pygame.display.set_mode((look.width_px, look.height_px), pygame.RESIZABLE)
        pygame.display.set_caption(f"drycut · {course.run.scenario.title}")
        pygame.key.set_repeat(300, 40)
        self._screen = Screen(course, look)
        self.controls = Controls(Playback(course, speed), self._screen)
        self._drawn, self._moved_s, self._settled_s = self.controls.view, 0.0, 0.0

    def play(self) -> None:
        """Play until the window is closed."""
        clock, last_s = pygame.time.Clock(), time.monotonic()
        while not self.controls.quits:
            for event in pygame.event.get():
                self.controls.handle(event)
            self._fit_window()
            now_s = time.monotonic()
            self.controls.playback.pass_time(now_s - last_s)
            last_s = now_s
            self.show(now_s)
            clock.tick(FPS)

    def show(self, now_s: float) -> None:
        """Show the present moment; `now_s` tells how long a view has rested."""
        controls, playback = self.controls, self.controls.playback
        controls.follow(self._course.at(playback.t_s).wire_um)
        frame = self._screen.frame(playback.t_s, controls.view, playback.speed, settled=self._settled(now_s))
        if controls.helps:
            draw_help(frame, THEMES[self._look.theme], self._look.language, self._screen.layout)
        self._surface.blit(_surface(frame), (0, 0))
        pygame.display.flip()

    def _settled(self, now_s: float) -> bool:
        """Whether the plot is to be drawn anew: its view rests, or has moved on for long."""
        if self.controls.view != self._drawn:
            self._drawn, self._moved_s = self.controls.view, now_s
        settled = now_s - self._moved_s >= CALM_S or now_s - self._settled_s >= STALE_S
        if settled:
            self._settled_s = now_s
        return settled

    def _fit_window(self) -> None:
        """Lay out the frames anew where the window has another size."""
        wide, tall = (max(pair) for pair in zip(self._surface.get_size(), LEAST_PX, strict=True))
        if (wide, tall) != self._look[:2]:
            self._look = self._look._replace(width_px=wide, height_px=tall)
            self._screen = Screen(self._course, self._look)
            self.controls.refit(self._screen)


def _surface(frame: Pixels) -> pygame.Surface:
    tall, wide = frame.shape[:2]
    return pygame.image.frombuffer(frame.data, (wide, tall), "RGB")
