"""Effects that a user saved: free-form laws that explained a log, one small file each."""
