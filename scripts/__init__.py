"""The subcommands of the console command `needle`."""
