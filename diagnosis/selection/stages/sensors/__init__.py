"""Stages about what sensors do beside effects: coloured noise, imperfections, outliers, jumps, drift."""
