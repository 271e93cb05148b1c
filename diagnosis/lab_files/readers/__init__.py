"""CSV, Parquet, MAT and MCAP files as tables of numbers."""
