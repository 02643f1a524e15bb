"""Settings of Sphinx; ``scripts/build_docs.py`` lays the sources out and calls it."""

from __future__ import annotations

import os
import sys
import tomllib
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml

ROOT = Path(os.environ["LEGORIZE_ROOT"])  # the sources are a copy, so __file__ does not tell
sys.path.insert(0, str(ROOT))

project = "Legorize"
author = "Legorize contributors"
copyright = "2026 Legorize contributors"
release = tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))["version"]

extensions = ["myst_parser", "numpydoc", "sphinx.ext.autodoc", "sphinx.ext.autosummary", "sphinx.ext.viewcode"]
myst_enable_extensions = ["deflist", "dollarmath"]
myst_heading_anchors = 3
exclude_patterns = ["CONTRIBUTING.md", "CHANGELOG.md"]  # included by pages of their own
autosummary_generate = False
autodoc_typehints = "none"  # the docstrings tell types with shapes and units
autodoc_member_order = "bysource"
numpydoc_show_class_members = False
add_module_names = False

html_theme = "furo"
html_title = f"Legorize {release}"
html_static_path: list[str] = []
html_show_sphinx = False
html_math_renderer = "mathml"


def inline_math(writer: Any, node: nodes.math) -> None:
    """Write a formula in a line as MathML, which browsers show without a script from elsewhere."""
    writer.body.append(tex2mathml(node.astext(), as_block=False))
    raise nodes.SkipNode


def block_math(writer: Any, node: nodes.math_block) -> None:
    """Write a formula of its own as MathML."""
    writer.body.append(f'<div class="math">{tex2mathml(node.astext(), as_block=True)}</div>\n')
    raise nodes.SkipNode


def setup(app: Any) -> None:
    """Add the writer of formulas."""
    app.add_html_math_renderer("mathml", (inline_math, None), (block_math, None))
