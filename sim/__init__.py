"""The third package: programs run on a table, cut, measured, made, shown and served; `drycut` is the door to it."""
