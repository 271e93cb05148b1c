"""Runs as named signals: in memory, as CSV or Parquet, as a picture, and for rerun's viewer."""
