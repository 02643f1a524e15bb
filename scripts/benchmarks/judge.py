"""An external judge on our bricks and on those of a peer.

The judge and the peer are two programs that come with neither Legorize nor this
script::

    judge.py MODEL OUT.ldr WIDTH --json FILE
    peer_voxels.py MODEL WIDTH OUT.ldr EVENTS.jsonl
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

from legorize_addon.core.errors import BuildError
from legorize_addon.core.files.ldraw import write_ldr
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh, repair
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.tables import Row, Table, Value

COLOUR: Final = 0.9
"""Largest error of colour over the floor, as a share of the peer's."""

VOLUME: Final = (0.85, 1.2)
"""Limits of the volume as a share of that of a closed mesh."""

Facts = dict[str, Any]


def measure(paths: Sequence[Path], *, judge: Path, out: Path, width: int, ldr_dir: Path | None) -> list[Table]:
    """Judge our bricks and a peer's on every model.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    judge : Path
        Folder with ``judge.py`` and ``peer_voxels.py``.
    out : Path
        Folder for bricks and judgements; the peer's are not made again where they are there.
    width : int
        Studs along the longer horizontal side.
    ldr_dir : Path or None
        Folder with ``NAME/model.ldr`` or ``NAME.ldr`` for every model; None lets the core make them.

    Returns
    -------
    list of Table
    """
    (out / "peer").mkdir(parents=True, exist_ok=True)
    (out / "ours").mkdir(exist_ok=True)
    rows: list[Row] = []
    ratios: list[Row] = []
    for path in paths:
        print(f"{path.stem}, {width} studs", file=sys.stderr, flush=True)
        mesh = read_mesh(path)
        own = out / "ours" / f"{path.stem}-{width}.ldr"
        bricks = found_bricks(ldr_dir, path.stem) if ldr_dir else _written(mesh, own, width)
        ours = judged(judge, path, bricks, width, own.with_suffix(".json"))
        peers = _peer(judge, path, width, out / "peer")
        rows += [_row(path.stem, who, facts) for who, facts in (("ours", ours), ("peer", peers))]
        ratios.append(_ratios(path.stem, ours, peers, closed=repair(mesh)[1].watertight))
    return [
        Table("judge", f"The judge at {width} studs", tuple(rows)),
        Table(
            "judge_ratios",
            f"Ours / the peer's: nearer to the surface, error of colour at most {COLOUR:g}",
            tuple(ratios),
        ),
    ]


def found_bricks(folder: Path, name: str) -> Path:
    """Return the LDraw file of a model in a folder of results."""
    for path in (folder / name / "model.ldr", folder / f"{name}.ldr"):
        if path.is_file():
            return path
    raise BuildError(
        f"{folder} has no {name}/model.ldr: run scripts/legorize.py on the model with --out {folder}/{name}."
    )


def _written(mesh: TriangleMesh, bricks: Path, width: int) -> Path:
    """Legorize a mesh with the core alone, into a file."""
    build = legorize(mesh, Settings(width=width))
    text = write_ldr(Assembly(build.bricks, load_catalogue()), name=bricks.name, title=bricks.stem)
    bricks.write_text(text, encoding="utf-8", newline="")
    return bricks


def _peer(judge: Path, path: Path, width: int, folder: Path) -> Facts:
    """Return what the judge says of the peer, from an earlier run if there was one."""
    said, bricks = folder / f"{path.stem}-{width}.json", folder / f"{path.stem}-{width}.ldr"
    if said.exists():
        facts: Facts = json.loads(said.read_text(encoding="utf-8"))
        return facts
    _run(judge / "peer_voxels.py", path, width, bricks, bricks.with_suffix(".jsonl"))
    return judged(judge, path, bricks, width, said)


def judged(judge: Path, path: Path, bricks: Path, width: int, said: Path) -> Facts:
    """Run the judge.

    Parameters
    ----------
    judge : Path
        Folder with ``judge.py``.
    path : Path
        Model file.
    bricks : Path
        LDraw file.
    width : int
        Studs along the longer horizontal side.
    said : Path
        Where the judgement is kept.

    Returns
    -------
    dict
        The judgement.

    Raises
    ------
    BuildError
        The judge fails, in its own words.
    """
    _run(judge / "judge.py", path, bricks, width, "--json", said)
    facts: Facts = json.loads(said.read_text(encoding="utf-8"))
    return facts


def _run(program: Path, *arguments: object) -> None:
    line = [sys.executable, str(program), *map(str, arguments)]
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    if done.returncode:
        last = (done.stderr.strip() or "no message").splitlines()[-1]
        raise BuildError(f"{program.name} failed on {arguments[0]}: {last}")


def _row(name: str, who: str, facts: Facts) -> Row:
    return {
        "model": name,
        "whose": who,
        "parts": facts["parts"],
        "collisions": facts["collision_cells"],
        "unread": facts["unread_parts"],
        "mirrored": "yes" if facts["mirrored"] else "no",
        "surface_mean": facts["surface_to_brick_mean"],
        "surface_lost": facts["surface_lost_share"],
        "volume_ratio": facts["volume_ratio"],
        "colour_error": facts["colour_error_mean"],
        "colour_floor": facts["colour_error_floor"],
        "over_floor": _over_floor(facts),
        "colour_wrong": facts["colour_wrong_share"],
        "components": facts["components"],
        "floating": facts["floating_bricks"],
    }


def _over_floor(facts: Facts) -> float:
    return float(round(facts["colour_error_mean"] - facts["colour_error_floor"], 4))


def _ratios(name: str, ours: Facts, peers: Facts, *, closed: bool) -> Row:
    return {
        "model": name,
        "surface_mean": _ratio(ours["surface_to_brick_mean"], peers["surface_to_brick_mean"]),
        "surface_lost": _ratio(ours["surface_lost_share"], peers["surface_lost_share"]),
        "over_floor": _ratio(_over_floor(ours), _over_floor(peers)),
        "colour_wrong": _ratio(ours["colour_wrong_share"], peers["colour_wrong_share"]),
        "parts": _ratio(ours["parts"], peers["parts"]),
        "sound_met": ours["collision_cells"] == ours["unread_parts"] == 0 and not ours["mirrored"],
        "nearer_met": ours["surface_to_brick_mean"] < peers["surface_to_brick_mean"],
        "volume_met": VOLUME[0] <= ours["volume_ratio"] <= VOLUME[1] if closed else None,
        "colour_met": _over_floor(ours) <= COLOUR * _over_floor(peers),
    }


def _ratio(ours: float, peers: float) -> Value:
    return ours / peers if peers else None
