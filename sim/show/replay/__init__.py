"""The replay: a page in which a run is watched again down to its single steps; the border type is the page's text."""
