"""What a mark is made of besides checked functions: questions, inputs that expose a wrong function, predictions."""
