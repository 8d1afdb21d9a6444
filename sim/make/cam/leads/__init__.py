"""How the wire comes from its thread point to a contour, and back; takes a `Thread`, gives `Curves`."""
