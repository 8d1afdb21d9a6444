"""What pictures are drawn on and with: canvases, paints, letters, layout. pygame draws, pillow finishes."""
