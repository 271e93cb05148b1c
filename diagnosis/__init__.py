"""The diagnosis: from a rig's log to the effects that its nominal model lacks."""
