"""When the samples of a trial were taken, where its time stamps do not say so."""
