"""What ``benchmark.py`` measures.

================  ==================================================================
``meshes``        reads model files without Blender; sizes and subdivides them
``clock``         CPU seconds
``tables``        results as Markdown, CSV and JSON
``slicing``       slices with loops, colours and areas against trimesh and shapely
``units``         unit bricks against trimesh, the exact rule and dense sampling
``dense``         the colours of unit bricks from densely sampled surface
``pipeline``      every stage on every model
``judge``         an external judge on our bricks and on a peer's
``surface``       how far the surface lies from the bricks, by the known alignment
``detail``        what plates gain and cost
``hollowing``     what hollowing leaves, against a fixed shell
``stability``     whether models stand, against HiGHS
``stablelego``    the cases published with StableLego
``goals``         every goal of the layout, a process a case
``layout_figures``  what is counted on a layout
``supports``      trees, columns and beams against full columns: Tables 2 and 4
``building``      building orders of every model, whole and in pieces
``mosaics``       mosaics of images, against a plain one
``kills``         killed runs
``fuzz``          random bodies with random settings
``mutation``      changes of the core that no test notices
``followed``      an order followed from its file, apart from the product's check
================  ==================================================================
"""
