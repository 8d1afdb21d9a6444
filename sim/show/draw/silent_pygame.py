"""pygame without its greeting, which would go to stdout, among our data: whoever draws with it takes it from here."""

import os

os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
import pygame
import pygame.font
import pygame.surfarray

__all__ = ["pygame"]
