"""The sizes of what is kept, beside their nominal ones; the border type is `Sizes`."""
