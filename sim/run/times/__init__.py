"""How long programs take in a shop, each time with its interval, and what that costs; the border is `Estimate`."""
