"""Families of laws that change in the course of a trial, or of a session."""
