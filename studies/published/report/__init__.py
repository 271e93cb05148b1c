"""The study for people and for programs: `paper.html`, `paper.json`."""
