"""From files and Blender's scene into the core."""
