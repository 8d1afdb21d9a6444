"""Drawings of parts, read from DXF into lines and arcs in µm and chained to loops; the border type is `Drawing`.

Only `read` and what lies below it load ezdxf; who needs the types alone imports `model`.
"""
