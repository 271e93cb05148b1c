"""What the console command `needle` runs."""
