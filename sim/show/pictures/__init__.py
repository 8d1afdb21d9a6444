"""Pictures of a run: each module draws one from what is known of it, on any canvas."""
