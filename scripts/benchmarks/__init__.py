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
``full_columns``  what supports are compared with
``building``      building orders of every model, whole and in pieces
``followed``      an order followed from its file, apart from the product's check
``layouts``       the layouts of the field and ours: Tables 1 and 3, and a peer
``laying``        one model by one method: its time, whether it is right and good
``energies``      the paper's energies of whole layouts
``layout_goals``  the claims on layouts as goals
``volumes``       the paper's Table 1
``peer``          the peer legolization, run as a process
``peer_layout``   the program that the peer's Python runs
``baselines``     layouts of the field, over all layers or upwards
``rules``         laying by a fixed key
``merging``       random maximal merging
``staggering``    greedy with penalties
``seams``         a layer upon another one: the energy of methods that search
``tiling``        A* over tilings
``annealing``     simulated annealing
================  ==================================================================
"""
