"""A diagnosis as files: JSON, a page, a recording, predictions."""
