"""In which order a model is built.

==================  =====================================================================
``moves``           a brick placed, a support taken out, a piece joined
``links``           what touches what on the way
``order``           every brick pushed onto something that holds
``balance``         towers that would fall over on the way
``walk``            the order followed move by move: the check
``proof``           every step tested by forces, where that is asked for
``order_file``      ``build_order.csv``
==================  =====================================================================
"""
