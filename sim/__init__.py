"""The table, the wire, the pictures and the command line of drycut; heavy imports stay inside its modules."""

__version__ = "0.1.0"
