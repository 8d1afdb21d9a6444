"""What all pages share: templates with everything escaped, data for scripts, one style and the switch of languages."""
