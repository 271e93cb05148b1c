"""The compiled tissue: everything that runs inside MuJoCo's passive callback."""
