"""What pictures are drawn on and with: canvases, paints, letters, layout; the border type is `Canvas`."""
