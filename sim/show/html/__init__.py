"""What all pages share: templates, data for scripts, one style, the switch of languages; the border type is text."""
