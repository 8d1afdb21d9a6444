"""Pictures of a run, each drawn from what is known of it; the border type is `Canvas`, drawn upon."""
