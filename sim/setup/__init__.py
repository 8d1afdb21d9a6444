"""What is to be run and on what: files of people, read strictly; what crosses the border is a `Scenario`."""
