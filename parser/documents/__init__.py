"""JSON that drycut writes: models of documents, and the JSON schemas made of them; the border is a `Document`."""
