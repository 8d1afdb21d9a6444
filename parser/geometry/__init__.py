"""Lines and arcs as plane geometry: where they lie, run, meet and come near; of a toolpath, a drawing or an offset."""
