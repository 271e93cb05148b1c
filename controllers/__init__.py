"""Estimators and controllers of the tip angle, from readings at the base. They import no simulator."""
