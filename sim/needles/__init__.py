"""Models and batches that are kept between runs, and steps without MuJoCo."""
