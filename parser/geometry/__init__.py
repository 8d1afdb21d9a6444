"""Lines and arcs as plane geometry: where they lie, run, meet and come near; what crosses the border is `Curves`."""
