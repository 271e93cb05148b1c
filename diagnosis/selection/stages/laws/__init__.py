"""Stages in which a law of the model is taken another way, where the log asks for it."""
