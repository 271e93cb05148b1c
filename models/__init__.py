"""Needle, tissue and drive; closed-form solutions; published figures. No simulator here."""
