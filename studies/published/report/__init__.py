"""The reports of the study: `paper.html` for readers, `paper.json` for programs."""
