"""Batches: what runs there are, each done once, and what is told of them."""

from __future__ import annotations

import csv
import json
import subprocess
import sys
from pathlib import Path

import pytest

from legorize_addon.core.errors import SettingsError
from scripts import batch
from scripts.batches import crew, table, work
from scripts.batches.plan import check_grid, checksum_of, models_in, read_grid, runs_of, tasks_of
from scripts.batches.work import Result, Task

FAKE = """
import json, sys, time
from pathlib import Path
source, out, key = sys.argv[1], Path(sys.argv[3]), sys.argv[5]
text = Path(source).read_text()
if "wait" in text:
    time.sleep(600)
if "bad" in text:
    sys.exit(f"{source} is bad: mend it.")
out.mkdir(parents=True, exist_ok=True)
figures = {"counts": {"bricks": len(text)}, "grid": {"layers": 1, "x": 2, "y": 3}, "mass_g": 1.0,
           "connection": {"components": 1, "floating": 0}, "stability": {"verdict": "stable"},
           "building": {"steps": 1}, "supports": {"removed": 0}, "timings_s": {"a": 0.5}, "notes": [],
           "failed_checks": ["One check failed."] if "weak" in text else [], "tag": key}
(out / "model.ldr").write_text("0 model\\n1 4 10 -24 10 1 0 0 0 1 0 0 0 1 3005.dat\\n0 STEP\\n")
(out / "parts.csv").write_text("")
(out / "report.json").write_text(json.dumps(figures))
"""
"""Stands for the script, which takes seconds: it writes what the batch reads."""


@pytest.fixture
def models(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder with three models, one of which is bad; the script is a fake."""
    fake = tmp_path / "fake.py"
    fake.write_text(FAKE)
    monkeypatch.setattr(batch, "program_of", lambda blender, script: (sys.executable, str(fake)))
    folder = tmp_path / "models"
    (folder / "deep").mkdir(parents=True)
    for name, text in (("a.stl", "good"), ("deep/b.obj", "also good"), ("c.glb", "bad")):
        (folder / name).write_text(text)
    return folder


def done(folder: Path, out: Path, *more: str) -> tuple[int, list[dict[str, str]]]:
    """Do a batch; return the exit status and the rows of the table."""
    status = batch.main([str(folder), "--out", str(out), "--jobs", "2", "--width", "4", "8", *more])
    with (out / "summary.csv").open(newline="") as file:
        return status, list(csv.DictReader(file))


def starts(out: Path) -> list[str]:
    """Return the runs that were begun, as the journal has them."""
    lines = [json.loads(line) for line in (out / "journal.jsonl").read_text().splitlines()]
    return sorted(line["run"] for line in lines if line["event"] == "start")


def test_failures_are_listed_and_do_not_stop_the_rest(
    models: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Every model at every width has a row; the sentence of the bad one is in it, and in the output."""
    status, rows = done(models, tmp_path / "out")
    assert status == 1
    assert [(row["model"], row["width"], row["status"]) for row in rows] == [
        ("a.stl", "4", "ok"), ("a.stl", "8", "ok"), ("c.glb", "4", "failed"), ("c.glb", "8", "failed"),
        ("b.obj", "4", "ok"), ("b.obj", "8", "ok"),
    ]  # fmt: skip
    assert all(row["sentence"].endswith("c.glb is bad: mend it.") == (row["status"] == "failed") for row in rows)
    assert "is bad: mend it." in capsys.readouterr().err
    page = (tmp_path / "out" / "summary.html").read_text()
    assert page.count("<img") == 4
    assert page.count("is bad") == 2
    assert len(json.loads((tmp_path / "out" / "summary.json").read_text())) == 6
    for row in rows:
        assert not row["picture"] or (tmp_path / "out" / row["picture"]).read_text().startswith("<svg")


def test_nothing_is_done_twice(models: Path, tmp_path: Path) -> None:
    """The same again keeps what is complete; a torn run, another model and another version are done."""
    (models / "c.glb").unlink()
    out = tmp_path / "out"
    assert done(models, out)[0] == 0
    first = starts(out)
    assert len(first) == 4
    status, rows = done(models, out)
    assert (status, {row["done"] for row in rows}) == (0, {"kept"})
    assert starts(out) == first
    report = out / "runs" / "a.stl" / "width-4" / "report.json"
    report.write_text(report.read_text()[:-20])
    (out / "runs" / "a.stl" / "width-8" / "model.ldr").unlink()
    (models / "deep" / "b.obj").write_text("changed")
    _, rows = done(models, out)
    assert {(row["model"], row["done"]) for row in rows} == {("a.stl", "built"), ("b.obj", "built")}
    assert len(starts(out)) == 8
    _, rows = done(models, out, "--plates", "none")
    assert {row["done"] for row in rows} == {"built"}


def test_failed_checks_are_no_failures(models: Path, tmp_path: Path) -> None:
    """All is there, but the exit status says that a check failed."""
    (models / "c.glb").write_text("weak")
    status, rows = done(models, tmp_path / "out")
    assert status == 2
    assert [row["sentence"] for row in rows if row["status"] == "checks failed"] == ["One check failed."] * 2


def test_a_stop_ends_what_runs(models: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is stopped leaves nothing behind, and is done when the batch goes on."""
    (models / "c.glb").write_text("wait")
    out, note = tmp_path / "out", work._note

    def stop_soon(task: Task, event: str, **more: object) -> None:
        note(task, event, **more)
        if event == "start" and task.name.startswith("c.glb"):
            Path(task.stop).touch()

    monkeypatch.setattr(work, "_note", stop_soon)
    status, rows = done(models, out)
    assert status == 130
    assert "stopped" in {row["status"] for row in rows if row["model"] == "c.glb"}
    assert not list(out.glob(".stop*"))
    monkeypatch.setattr(work, "_note", note)
    (models / "c.glb").write_text("good now")
    assert done(models, out)[0] == 0


def test_a_run_that_somebody_does_is_waited_for(tmp_path: Path) -> None:
    """Its lock is that of the process, whoever started it: the next one keeps what it makes."""
    fake, model = tmp_path / "fake.py", tmp_path / "a.stl"
    begun = tmp_path / "begun"
    fake.write_text(f"import time\nopen({str(begun)!r}, 'w').close()\ntime.sleep(1)\n{FAKE}")
    model.write_text("good")
    command = (sys.executable, str(fake), str(model), "--out", str(tmp_path / "runs" / "a"), "--tag", "key")
    task = Task("a", "key", command, str(tmp_path), str(tmp_path / "stop"))
    code = f"from scripts.batches.work import *; import scripts.batches.work as w; w.run({task!r})"
    other = subprocess.Popen([sys.executable, "-c", code], cwd=Path(batch.ROOT))
    while not begun.exists():
        assert other.poll() is None
    other.kill()
    other.wait()
    assert work.run(task).status == "kept"
    assert starts(tmp_path) == ["a"]


def test_models_of_a_folder(tmp_path: Path) -> None:
    """Meshes by name, also below; images only where there are no meshes; never the results of the batch itself."""
    for name in ("b.PLY", "a.png", "deep/c.jpg", "notes.txt", "out/runs/x.obj"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    assert [path.name for path in models_in(tmp_path, tmp_path / "out")] == ["b.PLY"]
    (tmp_path / "b.PLY").unlink()
    assert [path.name for path in models_in(tmp_path, tmp_path / "out")] == ["a.png", "c.jpg"]
    with pytest.raises(SettingsError, match="nothing in"):
        models_in(tmp_path / "out" / "runs", tmp_path / "out")
    with pytest.raises(SettingsError, match="no folder"):
        models_in(tmp_path / "none", tmp_path)


@pytest.mark.parametrize(
    ("name", "text"),
    [("grid.json", '{"width": [24, 48], "hollow": false}'), ("grid.toml", "width = [24, 48]\nhollow = false")],
)
def test_grids_of_files(tmp_path: Path, name: str, text: str) -> None:
    """One value or a list; flags and names of folders follow."""
    (tmp_path / name).write_text(text)
    grid = read_grid(tmp_path / name)
    assert grid == {"width": [24, 48], "hollow": [False]}
    check_grid(grid)
    found = runs_of([tmp_path / "m.stl"], tmp_path, grid, ["--render"])
    assert [(run.name, run.words) for run in found] == [
        ("m.stl/width-24", ("--width=24", "--no-hollow", "--render")),
        ("m.stl/width-48", ("--width=48", "--no-hollow", "--render")),
    ]


@pytest.mark.parametrize(
    ("grid", "message"),
    [
        ({"widht": [4]}, "no setting widht"),
        ({"width": []}, "no value"),
        ({"width": ["4"]}, "type int"),
        ({"width": [True]}, "type int"),
        ({"hollow": [1]}, "type bool"),
        ({"layout": ["slow"]}, "choose of fast"),
        ({"width": [4], "height": [4]}, "width and height"),
    ],
)
def test_wrong_grids_are_refused(grid: dict[str, list[object]], message: str) -> None:
    """Before anything is done."""
    with pytest.raises(SettingsError, match=message):
        check_grid(grid)


def test_names_of_runs_are_different(tmp_path: Path) -> None:
    """Letters that no folder should have are replaced, and a checksum tells equal names apart."""
    models = [tmp_path / name for name in ("a b.stl", "a_b.stl", "a:b.stl", f"{'x' * 90}.stl", f"{'x' * 91}.stl")]
    names = [run.name for run in runs_of(models, tmp_path, {"palette": ["1,4", "1 4"]}, [])]
    assert len(set(names)) == len(names) == 10
    assert all(len(part) < 80 and part.isascii() for name in names for part in name.split("/"))


def test_checksums_follow_what_a_file_names(tmp_path: Path) -> None:
    """The materials of an .obj file and their images count, files that nobody names do not."""
    (tmp_path / "m.obj").write_text("mtllib m.mtl\nv 0 0 0\n")
    (tmp_path / "m.mtl").write_text("newmtl a\nmap_Kd -s 1 1 a b.png\n")
    (tmp_path / "g.gltf").write_text('{"buffers": [{"uri": "g%20h.bin"}]}')
    before = {}
    for name in ("m.obj", "g.gltf"):
        before[name] = checksum_of(tmp_path / name)
    (tmp_path / "other.png").write_text("x")
    assert checksum_of(tmp_path / "m.obj") == before["m.obj"]
    (tmp_path / "m.mtl").write_text("newmtl a\nmap_Kd c.png\n")
    changed = checksum_of(tmp_path / "m.obj")
    assert changed != before["m.obj"]
    (tmp_path / "c.png").write_text("x")
    assert checksum_of(tmp_path / "m.obj") != changed
    (tmp_path / "g h.bin").write_text("x")
    assert checksum_of(tmp_path / "g.gltf") != before["g.gltf"]


def test_keys_follow_version_and_flags(tmp_path: Path) -> None:
    """Another version, or another flag, is another run."""
    (tmp_path / "m.stl").write_text("solid")
    keys = set()
    for version, flags in (("1", []), ("2", []), ("1", ["--render"])):
        runs = runs_of([tmp_path / "m.stl"], tmp_path, {"width": [4]}, flags)
        [task] = tasks_of(runs, tmp_path, program=("p",), version=version, stop=tmp_path / "s")
        keys.add(task.key)
    assert len(keys) == 3


def test_progress_tells_the_time_left(capsys: pytest.CaptureFixture[str]) -> None:
    """A line a run; what was kept does not count for the time."""
    line = crew.Line(3, sys.stdout)
    for name, status in (("a", "kept"), ("b", "built"), ("c", "failed")):
        line(Result(name, status))
    line.end()
    first, second, third = capsys.readouterr().out.splitlines()
    assert (first, third) == ("1/3 a: kept", "3/3 c: failed")
    assert second.startswith("2/3 b: built, ")
    assert second.endswith(" left")


def test_drawings_are_as_large_as_asked() -> None:
    """A single brick fills the picture."""
    text = table.drawing_of("0 model\n1 4 10 -24 10 1 0 0 0 1 0 0 0 1 3005.dat\n0 STEP\n")
    assert text.startswith("<svg")
    assert f"{table.WIDE:g}" in text[:200]


def test_a_real_batch(tmp_path: Path) -> None:
    """The script itself, on a box: a key in its report, a picture of it, and nothing to do the second time."""
    trimesh = pytest.importorskip("trimesh")
    (tmp_path / "in").mkdir()
    trimesh.creation.box((2, 1, 1)).export(tmp_path / "in" / "box.stl")
    arguments = [str(tmp_path / "in"), "--out", str(tmp_path / "out"), "--width", "4", "--jobs", "1"]
    assert batch.main(arguments) == 0
    [row] = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert row["verdict"] == "stable"
    assert row["studs_x"] == 4
    assert batch.main(arguments) == 0
    assert starts(tmp_path / "out") == ["box.stl/run"]


def test_dask_must_be_there(models: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Without the package, or without a scheduler, there is one sentence."""
    arguments = [str(models), "--out", str(tmp_path / "out"), "--dask", "tcp://127.0.0.1:1"]
    try:
        import distributed  # noqa: F401
    except ModuleNotFoundError:
        assert batch.main(arguments) == 1
        assert "run scripts/run.py setup --dask" in capsys.readouterr().err


@pytest.mark.slow
def test_dask_cluster(models: Path, tmp_path: Path) -> None:
    """A real cluster of two workers does all runs, each once."""
    distributed = pytest.importorskip("distributed")
    cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, processes=True)
    with cluster:
        status, rows = done(models, tmp_path / "out", "--dask", cluster.scheduler_address)
    assert status == 1
    assert [row["status"] for row in rows].count("ok") == 4
    assert len(starts(tmp_path / "out")) == len(set(starts(tmp_path / "out"))) == 6
