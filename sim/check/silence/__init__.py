"""What keeps a finding from being shown: settings, remarks in the program, a baseline; all of it is counted."""
