"""What a log tells of an effect that the library lacks: its place, its variable, its law, in words."""
