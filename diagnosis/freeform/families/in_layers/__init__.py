"""Free laws of tissue in layers: what a piece of shaft meets depends on its depth below the surface."""
