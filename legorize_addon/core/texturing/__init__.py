"""Textures at the size of the model: what of them is seen, how finely, and as which colours."""
