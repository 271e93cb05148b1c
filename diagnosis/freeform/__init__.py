"""What an unknown effect is like: free-form laws, fitted through the simulation."""
