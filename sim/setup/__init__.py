"""What is to be run and on what: files of people, read strictly; across the border go `Scenario` and `Machine`."""
