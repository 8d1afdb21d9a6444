"""The order in which figures are cut, and which way round; takes and gives `Figure`s with their `Thread`s."""
