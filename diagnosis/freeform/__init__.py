"""The law of an unknown effect: free-form laws, fitted by simulation."""
