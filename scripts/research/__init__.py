"""What the product never runs: layouts of the field to compare with, training and its controls, the sample.

================  ==================================================================
``full_columns``  what supports are compared with
``layouts``       the layouts of the field and ours: Tables 1 and 3, and a peer
``laying``        one model by one method: its time, whether it is right and good
``energies``      the paper's energies of whole layouts
``layout_goals``  the claims on layouts as goals
``volumes``       the paper's Table 1
``paper_tables``  the paper's Tables 1 to 4
``claims``        its claims as goals
``claim_figures``  what they need beside the tables
``five_kinds``    models of the five kinds that it shows
``peer``          the peer legolization, run as a process
``peer_layout``   the program that the peer's Python runs
``baselines``     layouts of the field, over all layers or upwards
``rules``         laying by a fixed key
``merging``       random maximal merging
``staggering``    greedy with penalties
``seams``         a layer upon another one: the energy of methods that search
``tiling``        A* over tilings
``annealing``     simulated annealing
``train_layout``  makes the samples of the learned exchanges, and judges what was learned
``training_models``  the models that these samples are taken from
``layout_controls``  what the exchanges are worth without learning
``train_fill``    makes the samples of the learned fill, and judges what was learned
``fill_controls``  what its search is worth with something else to decide
``fill_report``    the figures of both, kept as they come
``make_samples``  models and paints the sample
``rooster``       its shape and colours
================  ==================================================================
"""

from __future__ import annotations
