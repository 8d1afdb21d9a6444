"""``python -m sim``, where the command is not on the path."""

from sim.cli import main

main()
