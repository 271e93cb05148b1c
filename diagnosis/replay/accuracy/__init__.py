"""How accurate a replay is: its numerical error, and motions of the base between samples."""
