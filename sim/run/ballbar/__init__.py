"""The circular test of ISO 230-4 on a machine: run, figures, parts; what crosses the border is a document."""
