"""One contact site: its law, torque against slip, and what it remembers."""
