"""What stands in a DXF file, each entity where it is placed; the border types are `Placed` and `ReadEntity`."""
