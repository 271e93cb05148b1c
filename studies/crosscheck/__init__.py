"""MuJoCo's needle checked against closed forms, conservation, and the published figures."""
