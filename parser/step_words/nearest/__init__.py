"""Words of a path whose blocks all end as near as whole µm let them; the border type is `Chained`."""
