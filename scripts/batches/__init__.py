"""Many models at once: what ``scripts/batch.py`` is made of.

=========  ===========================================================
``plan``   from a folder and a grid of settings to runs
``work``   one run, in a process of its own, never done twice
``crew``   all runs, by local processes or a Dask cluster
``table``  what came of them: CSV, JSON, and a page with pictures
=========  ===========================================================
"""
