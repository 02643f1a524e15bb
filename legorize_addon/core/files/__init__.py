"""What is written: files of the model, and the folder that they come in."""
