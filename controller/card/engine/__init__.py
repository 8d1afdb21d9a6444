"""What moves behind the functions of the card: the list is planned, run and braked over simulated time.

Calls give it an `Entry` of the list; out of it come `Pulses`.
"""
