"""The picture of a plan: what is cut in which order, from where and on which way; the border type is `CutPlan`."""
