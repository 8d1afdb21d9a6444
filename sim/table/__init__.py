"""The two-axis table: motors, drives, guides and slides, followed tick by tick in pymunk."""
