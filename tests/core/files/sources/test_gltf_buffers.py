"""The buffers of glTF files, and the addresses of other files."""

from __future__ import annotations

import base64
import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from legorize_addon.core.files.sources.preflight import check_source
from tests.core.files.sources.written import box_data, box_document, refusal

Json = dict[str, Any]


def separate(folder: Path, address: str, table: str = "buffers") -> Path:
    """Write a .gltf file with an address of a buffer or an image."""
    document = box_document()
    if table == "images":
        document["images"] = [{"uri": address}]
        document["buffers"][0]["uri"] = "data:;base64," + base64.b64encode(box_data()).decode()
    else:
        document["buffers"][0]["uri"] = address
    path = folder / "box.gltf"
    path.write_text(json.dumps(document))
    return path


@pytest.mark.parametrize("address", ["box.bin", "parts/box.bin", "parts/../box.bin", "my%20box.bin", "parts\\box.bin"])
def test_addresses_in_the_folder_pass(address: str, tmp_path: Path) -> None:
    """Files beside the document and below it, as exporters write their addresses."""
    (tmp_path / "parts").mkdir()
    for name in ("box.bin", "parts/box.bin", "my box.bin"):
        (tmp_path / name).write_bytes(box_data())
    assert check_source(separate(tmp_path, address), ()) == ()


@pytest.mark.parametrize("table", ["buffers", "images"])
@pytest.mark.parametrize(
    "address",
    [
        *("../box.bin", "parts/../../box.bin", "%2e%2e/box.bin", "..\\box.bin", "/box.bin", "C:\\box.bin", ".."),
        *("ftp://elsewhere/box.bin", "file:///box.bin", "//[box.bin", "box%00.bin"),
    ],
)
def test_addresses_out_of_the_folder(address: str, table: str, tmp_path: Path) -> None:
    """Nothing is read from elsewhere, whether or not it is there."""
    (tmp_path / "inner").mkdir()
    (tmp_path / "box.bin").write_bytes(box_data())
    assert "not a file in its folder" in refusal(separate(tmp_path / "inner", address, table))


@pytest.mark.skipif(os.name != "posix", reason="pipes with a name")
@pytest.mark.parametrize("table", ["buffers", "images"])
@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir])
def test_addresses_of_what_is_no_file(make: Callable[[Path], None], table: str, tmp_path: Path) -> None:
    """A pipe would be waited for without end."""
    make(tmp_path / "box.bin")
    assert "'box.bin', which is not a file" in refusal(separate(tmp_path, "box.bin", table))


def test_missing_and_short_buffer(tmp_path: Path) -> None:
    """A buffer has to be there, with all its bytes."""
    path = separate(tmp_path, "box.bin")
    assert "'box.bin', which is missing" in refusal(path)
    (tmp_path / "box.bin").write_bytes(box_data()[:-1])
    assert "should have 240 bytes, but there are 239" in refusal(path)


@pytest.mark.parametrize("address", ["data:;base64,AAA", "data:,AAAA", "data:;base64,AAAA"])
def test_buffer_in_the_address(address: str, tmp_path: Path) -> None:
    """Text that is no base64, and such that is too short."""
    assert "incomplete or damaged" in refusal(separate(tmp_path, address))
