"""Legorization without Blender: from a textured mesh to a brick model, stage by stage.

======================  ====================================================================
``mesh``                a triangle mesh at the door: checked, repaired, oriented, scaled
                        (``mesh_repair``, ``mesh_orientation``, ``mesh_topology``)
``geometry.upright``    which way is up: turning, and how a shape would stand
``colours``             dominant colours of the textures -> brick colours that can be bought
                        (``texels``, ``colour_difference``)
``texturing``           what alpha hides is left out (``cutouts``, ``splitting``); images no finer than matters at a
                        stud (``reduced_images``, ``box_means``), texture within a stud as its mean (``fine_textures``)
``grid``                where the cells of 8 x 8 x 9.6 mm lie, and the height of the first layer
``slicing``             heights of the slices (``marking``); planes x triangles -> segments
``trajectories``        segments -> closed, oriented, nested loops with a colour on every edge
                        (``linking``, ``loops``, ``nesting``, ``simplify``)
``unit_bricks``         loops on the grid -> which cells are bricks or plates, in which colour
                        (``levels``, ``coverage``, ``pass_through``; ``rays``, ``samples``; ``thin_features``,
                        ``bridges``; ``exposure``, ``skins``, ``cell_colours``, ``eight_neighbours``)
``detail``              where plates stay and where three of them are a brick again; neighbouring columns agree
                        where that saves parts (``agreement``, ``conditional_modes``)
``overhangs``           horizontal faces between trajectories: offset bricks, kinds of overhang
                        (``offset_bricks``)
``backing``             bricks behind flat pictures and reliefs (``facing``)
``hollowing``           which cells must be built, may be built, or stay empty (``regions``, ``ceilings``)
``holding``             what the shell needs to hold together: something between bodies that nearly touch,
                        plates under roofs of one layer, plates in walls (``bodies``, ``reinforcement``, ``joints``)
``layout``              which bricks cover the cells; in the end plates across what is loose still, some of
                        them in the neighbour's colour (``layout.straps``)
``seen_filler``         bricks of no colour that are seen take that of what they hold
``connection``          what holds to what
``stability``           whether it stands: forces in balance, or a collapse, as proof (``statics``,
                        ``equilibrium``, ``collapse``, ``tipping``)
``remarks``             what does not hold or stand, and what a builder has to know, in sentences
                        (``separation``: why components are not one)
``segmentation``        pieces that are built on the table and joined, where that saves supports
``supports``            what stands below bricks while the model is built; what stays of it
``building``            the order in which every brick finds hold, and its check (``building_remarks``)
``ldraw``               bricks <-> LDraw text (``ldraw_document``: pieces and supports as sub-models)
``shopping``            parts lists and the shops' files
``report``              what was built, in numbers
``tables``              the paper's four tables of one model
``size``                the scale, and what is too large or too small
``build``               the result of every stage
``pipeline``            the stages in order: :func:`legorize_addon.core.pipeline.legorize`
======================  ====================================================================

``units``, ``errors``, ``progress``, ``settings``, ``catalogue``, ``model``,
``outline``, ``pieces`` and ``ranges`` hold what the stages share. Nothing in this folder
imports ``bpy``.
"""
