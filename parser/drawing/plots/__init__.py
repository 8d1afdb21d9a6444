"""Drawings that are no DXF, as documents of lines and arcs: plotter files (HPGL), SVG, lists of curves (CSV)."""
