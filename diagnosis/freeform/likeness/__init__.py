"""From a free-form curve to the name of a plain law."""
