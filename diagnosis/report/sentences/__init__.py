"""What a diagnosis says in sentences, for the page, the screen and the recording."""
