"""What a lab's columns probably are: every guess with its reason, none believed unseen."""
