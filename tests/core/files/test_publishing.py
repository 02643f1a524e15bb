"""New files take the place of old ones all at once: killed at any moment, or with something in the way."""

from __future__ import annotations

import os
import shutil
import signal
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.files import publishing
from legorize_addon.core.files.folder import new_folder
from legorize_addon.core.files.publishing import replace_folder
from legorize_addon.core.files.workplace import PREFIX

KILLS = pytest.mark.skipif(not hasattr(os, "fork"), reason="a copy of this process is killed")
SWAPS = sys.platform in ("linux", "darwin")
MINE = {"mine.txt": "the user's", "tables/mine.csv": "the user's, too"}


@pytest.fixture(params=["swap", "moves"])
def way(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """Publish by letting folders change places, and by moving files one by one."""
    if request.param == "moves":
        monkeypatch.setattr(publishing, "exchange", lambda one, other: False)
    return str(request.param)


def results(label: str) -> dict[str, str]:
    """Return the files of a run; two runs share some names and not others."""
    names = ["model.ldr", "tables/table_1.csv", f"only-{label}.txt", f"deep/{label}/only.txt"]
    return dict.fromkeys(names, label) | {"report.json": '{"label": "' + label + '"}'}


def write(folder: Path, files: dict[str, str]) -> None:
    """Write files of the given contents."""
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


def publish(out: Path, label: str, before: Callable[[], object] = lambda: None) -> None:
    """Publish the files of a run."""
    with new_folder(out) as folder:
        write(folder, results(label))
        before()


def contents(folder: Path) -> dict[str, str]:
    """Return all files, the report without the list that was added, and folders that are empty."""
    files = {path.relative_to(folder).as_posix(): path.read_text() for path in folder.rglob("*") if path.is_file()}
    empty = {
        f"{path.relative_to(folder)}/": "" for path in folder.rglob("*") if path.is_dir() and not any(path.iterdir())
    }
    return {name: text.split('"files"')[0] if name == "report.json" else text for name, text in files.items()} | empty


def whole(label: str) -> dict[str, str]:
    """Return what is there of a run and of the user."""
    return {**results(label), **MINE, "report.json": '{\n  "label": "' + label + '",\n  '}


@pytest.fixture
def out(tmp_path: Path) -> Path:
    """Return a folder with the results of an earlier run and the user's own files."""
    folder = tmp_path / "above" / "out"
    publish(folder, "old")
    write(folder, MINE)
    return folder


def test_new_takes_the_place_of_old(out: Path, way: str) -> None:
    """What the new run does not write is gone, with the folders of it; the user's files are the same files."""
    before = {name: (out / name).stat().st_ino for name in MINE}
    publish(out, "new")
    assert contents(out) == whole("new")
    assert {name: (out / name).stat().st_ino for name in MINE} == before
    assert [entry.name for entry in out.parent.iterdir()] == ["out"]


def killed(out: Path, moment: int) -> bool:
    """Publish in a copy of this process that kills itself before the n-th call to the file system; tell if it lived."""
    child = os.fork()
    if not child:
        seen = iter(range(1, 10**9))

        def kill(event: str, arguments: object) -> None:
            if event.split(".")[0] in ("os", "open", "shutil", "ctypes") and next(seen) == moment:
                os.kill(os.getpid(), signal.SIGKILL)

        publish(out, "new", lambda: sys.addaudithook(kill))
        os._exit(0)
    return os.waitpid(child, 0)[1] == 0


@KILLS
def test_killed_at_any_moment(tmp_path: Path, out: Path, way: str) -> None:
    """Old or new, whole: at once where folders change places, else after the next run came by; nothing is left."""
    seen, torn = [], 0
    for moment in range(1, 1000):
        copy = tmp_path / "copies" / "out"
        shutil.copytree(out, copy)
        lived = killed(copy, moment)
        at_once = contents(copy)
        if way == "swap" and SWAPS:
            assert at_once in (whole("old"), whole("new"))
        torn += at_once not in (whole("old"), whole("new"))
        with pytest.raises(BuildError, match="nothing new"), new_folder(copy):
            raise BuildError("nothing new")
        assert contents(copy) in (whole("old"), whole("new"))
        assert at_once in (contents(copy), *([at_once] if way == "moves" else []))
        assert [entry.name for entry in copy.parent.iterdir()] == ["out"]
        seen.append(contents(copy) == whole("new"))
        shutil.rmtree(copy.parent)
        if lived:
            break
    assert lived
    assert len(seen) > 30
    # once it is the new one, it stays the new one
    assert seen == sorted(seen)
    assert 0 < sum(seen) < len(seen)
    assert torn == 0 if way == "swap" and SWAPS else torn > 3


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_what_fails_half_way_is_taken_back(out: Path, error: BaseException, monkeypatch: pytest.MonkeyPatch) -> None:
    """A move that fails, or a stop in between, gives the old folder, at whichever move it comes."""
    monkeypatch.setattr(publishing, "exchange", lambda one, other: False)
    replace = os.replace
    for moment in range(1, 100):
        moves = iter(range(1, 1000))

        def failing(source: Path, target: Path, moves: Iterator[int] = moves, moment: int = moment) -> None:
            if next(moves) == moment:
                raise error
            replace(source, target)

        with monkeypatch.context() as patch:
            patch.setattr(publishing.os, "replace", failing)
            try:
                publish(out, "new")
            except (BuildError, KeyboardInterrupt):
                assert contents(out) == whole("old")
                assert [entry.name for entry in out.parent.iterdir()] == ["out"]
            else:
                break
    assert moment > 8
    assert contents(out) == whole("new")


@pytest.mark.parametrize(
    ("name", "words"), [("report.json", "is a folder"), ("only-new.txt", "is a folder"), ("deep/new", "is a file")]
)
def test_something_in_the_way_changes_nothing(out: Path, way: str, name: str, words: str) -> None:
    """A folder in the place of a file, or a file in the place of a folder, is found before the first move."""
    if words == "is a folder":
        (out / name).unlink(missing_ok=True)
        (out / name).mkdir()
    else:
        (out / name).write_text("in the way")
    before = contents(out)
    with pytest.raises(BuildError, match=words):
        publish(out, "new")
    assert contents(out) == before
    assert [entry.name for entry in out.parent.iterdir()] == ["out"]


@pytest.mark.parametrize("name", ["only-new.txt", "deep/mine.txt"])
@pytest.mark.parametrize("link", [False, True])
def test_files_that_no_run_wrote_are_not_replaced(out: Path, way: str, name: str, link: bool) -> None:
    """A file or link of the user's that has the name of a result refuses the run, and stays."""
    (out / name).unlink(missing_ok=True)
    (out / name).parent.mkdir(exist_ok=True)
    if link:
        (out / name).symlink_to("nowhere")
    else:
        (out / name).write_text("mine")
    before = contents(out)
    with pytest.raises(BuildError, match=f"{name} is a file that no earlier run wrote"), new_folder(out) as folder:
        write(folder, {name: "new", "report.json": "{}"})
    assert contents(out) == before
    with pytest.raises(BuildError, match=f"{name} is a file that"), new_folder(out, names=[name]):
        pytest.fail("this is known before the work")
    assert contents(out) == before
    assert [entry.name for entry in out.parent.iterdir()] == ["out"]


def test_folders_of_the_user_stay_where_they_are(out: Path, way: str) -> None:
    """With a folder of the user's, files are moved one by one, and the folder is the same one."""
    write(out, {"photos/holiday/1.txt": "sea"})
    before = (out / "photos").stat().st_ino, out.stat().st_ino
    publish(out, "new")
    assert ((out / "photos").stat().st_ino, out.stat().st_ino) == before
    assert contents(out) == whole("new") | {"photos/holiday/1.txt": "sea"}


def test_what_the_user_saves_meanwhile_is_kept(out: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file saved in the old folder at the last moment comes along."""
    exchange = publishing.exchange

    def late(one: Path, other: Path) -> bool:
        write(other, {"late.txt": "just now"})
        (other / "partial").write_text("saved anew")
        os.replace(other / "partial", other / "mine.txt")
        return exchange(one, other)

    monkeypatch.setattr(publishing, "exchange", late)
    publish(out, "new")
    assert contents(out) == whole("new") | {"late.txt": "just now", "mine.txt": "saved anew"}


def test_rights_of_the_folder_stay(out: Path, way: str) -> None:
    """Whoever may read the folder may do so afterwards."""
    out.chmod(0o750)
    publish(out, "new")
    assert out.stat().st_mode & 0o777 == 0o750


def test_links_of_the_user_stay_links(out: Path, way: str, tmp_path: Path) -> None:
    """A link of the user's is kept as it is, and one in the place of a result is replaced, not followed."""
    (tmp_path / "far.txt").write_text("far")
    (out / "link").symlink_to(tmp_path / "far.txt")
    (out / "nowhere").symlink_to("nothing")
    (out / "model.ldr").unlink()
    (out / "model.ldr").symlink_to(tmp_path / "far.txt")
    publish(out, "new")
    assert os.readlink(out / "link") == str(tmp_path / "far.txt")
    assert os.readlink(out / "nowhere") == "nothing"
    assert not (out / "model.ldr").is_symlink()
    assert (tmp_path / "far.txt").read_text() == "far"


def test_begun_moves_of_a_folder_that_is_gone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What was begun for a folder that somebody removed is dropped, not put there again."""
    monkeypatch.setattr(publishing, "exchange", lambda one, other: False)
    monkeypatch.setattr(publishing, "carry_out", lambda work, moves: None)
    work = tmp_path / f"{PREFIX}0"
    write(work, {f"new/out/{name}": text for name, text in results("new").items()} | {"lock": ""})
    (tmp_path / "out").mkdir()
    replace_folder(work, work / "new" / "out", tmp_path / "out")
    (tmp_path / "out").rmdir()
    monkeypatch.undo()
    publish(tmp_path / "other", "new")
    assert [entry.name for entry in tmp_path.iterdir()] == ["other"]
