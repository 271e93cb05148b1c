"""The gap of the published rig: Tables II, IV and V as measurements (`needle diagnose --paper`)."""
