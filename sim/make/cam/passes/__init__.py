"""The passes over a figure, with their leads, tab and overcut; the border type is `PassCut`."""
