"""Legorization without Blender: from a textured mesh to a brick model, stage by stage.

Each package is a stage or what several stages share; its ``__init__`` names what
it offers, and everything else in it is private. Each imports only from those
above it in this table.

===================  =======================================================================
``geometry``         helpers on plain arrays
``model``            catalogue, unit grid, table of bricks, graph of their contacts
``stock``            what parts cost and which ones a user owns, from files of other programs
``mesh``             the triangle mesh: checked, repaired, oriented, upright, scaled
``colours``          dominant colours of the textures -> brick colours that exist
``texturing``        what can be seen of the textures at the size of the model
``slicing``          heights of the slices; planes x triangles -> closed, nested, coloured loops
``unit_bricks``      loops on the grid -> which cells are bricks or plates, in which colour
``shell``            which cells must be built, may be built, or stay empty; what holds them together
``layout``           which bricks cover the cells, joined into one model
``mosaic``           mosaics of images: studs, colours, base, surface
``statics``          whether it stands: forces in balance, or a collapse, as proof
``building``         an order in which every brick can be placed, and its check
``supports``         temporary supports, pillars that stay, and pieces that are joined
``owned``            building with owned parts
``measures``         figures for the report that building does not need
``instructions``     the booklet of the steps and layer maps, as SVG, HTML and PDF
``shopping``         what to buy: lots, and the lists that shops read
``files``            LDraw documents, the folder of the results
``ldraw``            LDraw documents back to bricks
``report``           what was built, in numbers and sentences
===================  =======================================================================

``arrays``, ``units``, ``errors``, ``safe_text``, ``progress``, ``settings``,
``settings_file`` and ``presets`` lie below all of them; ``estimate`` and
``limits`` (what a build will come to, and what is too large), ``build`` (the result of every stage), ``stages``
(what the settings mean for each stage), ``pipeline`` (the stages in order) and ``existing`` (models that exist already)
above. Nothing in this folder imports ``bpy``.
"""
