"""The release script: every reason against a release is told, and only a clean, tagged tree is built."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from scripts import release

CHANGELOG = "# Changelog\n\n## [1.2.0] - 2026-03-04\n\n- New.\n\n## [1.1.0] - 2026-01-02\n"
CITATION = 'cff-version: 1.2.0\nversion: "1.2.0"\ndate-released: "2026-03-04"\n'


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """Return a repository that can be released as v1.2.0."""
    (tmp_path / "blender_manifest.toml").write_text('version = "1.2.0"\n')
    (tmp_path / "CHANGELOG.md").write_text(CHANGELOG)
    (tmp_path / "CITATION.cff").write_text(CITATION)
    git(tmp_path, "init", "-q")
    commit(tmp_path)
    git(tmp_path, "tag", "v1.2.0")
    return tmp_path


def git(root: Path, *words: str) -> None:
    """Run git as somebody, with nobody's own settings."""
    who = ["-c", "user.name=A", "-c", "user.email=a@b", "-c", "commit.gpgsign=false", "-c", "tag.gpgsign=false"]
    subprocess.run(["git", *who, *words], cwd=root, check=True, capture_output=True)


def commit(root: Path) -> None:
    """Commit all that is there."""
    git(root, "add", "-A")
    git(root, "commit", "-q", "-m", "all")


def test_a_tree_that_fits(tree: Path) -> None:
    """Nothing is said against it."""
    assert list(release.reasons("v1.2.0", tree)) == []


def test_tag_is_the_version(tree: Path) -> None:
    """Another tag is refused, also one without the v."""
    for tag in ("v1.2.1", "1.2.0"):
        assert any(f"The tag {tag} is not v1.2.0" in reason for reason in release.reasons(tag, tree))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("# Changelog\n", "has no section [1.2.0]"),
        (CHANGELOG.replace("1.2.0", "1.3.0").replace("1.1.0", "1.2.0"), "is [1.3.0], not [1.2.0]"),
        (CHANGELOG.replace(" - 2026-03-04", ""), "has no date"),
        (CHANGELOG.replace("2026-03-04", "soon"), "has no date"),
        ("## [Unreleased]\n" + CHANGELOG, "is [Unreleased], not [1.2.0]"),
    ],
)
def test_changelog(text: str, said: str) -> None:
    """The version needs the newest section, with a date."""
    [fault] = release.changelog_faults("1.2.0", text)
    assert said in fault


@pytest.mark.parametrize(("old", "new"), [('"1.2.0"', '"1.1.0"'), ("2026-03-04", "2026-03-05"), ("date-released", "x")])
def test_citation(old: str, new: str) -> None:
    """The citation has the release's version and date; the version of the format itself is not meant."""
    assert len(list(release.citation_faults("1.2.0", "2026-03-04", CITATION.replace(old, new)))) == 1


def test_changed_files_are_refused(tree: Path) -> None:
    """What is not committed would not be in the tag."""
    (tree / "new.txt").write_text("new")
    assert list(release.reasons("v1.2.0", tree)) == ["There are uncommitted changes: commit or stash them."]


def test_tag_is_on_this_commit(tree: Path) -> None:
    """A tag that is missing or stands elsewhere is refused."""
    (tree / "new.txt").write_text("new")
    commit(tree)
    assert list(release.reasons("v1.2.0", tree)) == ["The tag v1.2.0 is on another commit: check that one out."]
    git(tree, "tag", "-d", "v1.2.0")
    assert list(release.reasons("v1.2.0", tree)) == ["There is no tag v1.2.0: create it with git tag -a v1.2.0."]


def test_nothing_is_built_where_something_is_wrong(
    tree: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The reasons are printed and the status is 1; in a tree that fits, zips for all platforms and Pythons are."""
    built: list[tuple[list[str], str | None]] = []
    monkeypatch.setattr(release, "ROOT", tree)

    def build(platforms: list[str], out: Path, *, python: str | None) -> list[Path]:
        """Note what is built."""
        built.append((platforms, python))
        return [Path(f"{python}.zip")]

    monkeypatch.setattr(release, "build", build)
    assert release.main(["v9"]) == 1
    assert not built
    assert "The tag v9 is not v1.2.0" in capsys.readouterr().err
    assert release.main(["v1.2.0"]) == 0
    assert built == [(list(release.TAGS), python) for python in (None, *release.PYTHONS)]
    said = capsys.readouterr().out
    assert "git push origin v1.2.0" in said
    assert all(f"{python}.zip" in said for _, python in built)
