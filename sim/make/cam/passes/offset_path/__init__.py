"""The way of the wire all round a contour, at an offset from it; takes a `Figure`, gives `Curves`."""
