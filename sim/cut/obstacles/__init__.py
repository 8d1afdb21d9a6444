"""Workpiece, clamps and arm: what touches them, and where the wire leaves the work; gives findings."""
