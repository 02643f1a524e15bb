"""The checks that decide whether a finished model is good."""

from __future__ import annotations

from typing import Any


def failed_checks(facts: dict[str, Any]) -> list[str]:
    """Return a line for each check that a finished model failed.

    Where nothing is to be strengthened, how it stands is told and not a fault.
    """
    graph, colours = facts["connection"], facts["unavailable_part_colours"]
    counts = (
        (graph["components"], 1, "Components that are not joined: {}."),
        (graph["floating"], 0, "Floating bricks, joined to nothing on the ground: {}."),
        (graph["collisions"], 0, "Cells that more than one brick fills: {}."),
        (facts["building"]["steps"] - facts["buildable_steps"], 0, "Steps that cannot be built: {}."),
        (colours["bricks"], 0, "Bricks in a colour in which their part is not made: {}."),
    )
    failed = [sentence.format(count) for count, allowed, sentence in counts if count > allowed]
    if not facts["building"]["ends_as_model"]:
        failed.append("The building order does not end with the finished model.")
    proof = facts["building"]["proof"]
    if proof and proof["collapsing"] + proof["undecided"]:
        failed.append(f"Steps not proven to stand: {len(proof['collapsing'] + proof['undecided'])}.")
    if not facts["stability"]["stable"] and facts.get("settings", {}).get("strengthen", True):
        failed.append(
            "Stability is not proven: {verdict}, {failing} bricks bear too little.".format(**facts["stability"])
        )
    return failed
