"""Reading `rig-log/1`: the nominal rig, its trials, and what is wrong or doubtful about them."""
