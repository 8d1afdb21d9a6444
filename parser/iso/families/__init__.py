"""Which family a listing was written for, in which scale and modes, and why: `ToldProfile`, its assumptions."""
