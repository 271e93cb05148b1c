"""What one log cannot hold: columns or trials that contradict each other."""
