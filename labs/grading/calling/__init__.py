"""Our side of a call: the processes that a submission's functions run in, their deadlines, and their answers."""
