"""Legorization without Blender: from a textured mesh to a brick model, stage by stage.

======================  ====================================================================
``mesh``                a triangle mesh at the door: checked, repaired, oriented, scaled
``colours``             dominant colours of the textures -> brick colours that can be bought
``slicing``             heights of the slices; planes x triangles -> segments
``trajectories``        segments -> closed, oriented, nested loops with a colour on every edge
``unit_bricks``         loops on the 8 mm grid -> which cells are bricks, in which colour
``hollowing``           which cells must be built, may be built, or stay empty
``layout``              which bricks cover the cells
``ldraw``               bricks <-> LDraw text
``pipeline``            the stages in order: :func:`legorize_addon.core.pipeline.legorize`
======================  ====================================================================

``units``, ``errors``, ``progress``, ``settings``, ``catalogue`` and ``model``
hold what the stages share. Nothing in this folder imports ``bpy``.
"""
