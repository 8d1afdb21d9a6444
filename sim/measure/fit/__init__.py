"""What of a machine a measured circle tells, with intervals, and what it cannot tell; the border is `CircleFit`."""
