"""MuJoCo's needle held to closed forms, to conservation, and to the published figures."""
