"""Workpiece, clamps and arm: what touches them, where the wire leaves the work; the border type is `Finding`."""
