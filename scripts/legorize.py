"""Legorize a file without a window.

::

    blender -b -P scripts/legorize.py -- IN --out DIR [--width STUDS | --height BRICKS | --scale K] [more]
    python scripts/legorize.py IN --out DIR ...        where Blender is installed as the module bpy

IN is a .blend, .obj, .glb, .gltf, .ply, .stl or .fbx file. The script reads what
a render would show: a .blend at the frame at which it was saved, any other file
in its rest pose, without animation. IN may also be a brick model, .ldr or .mpd,
which is judged as our own, or laid again; or an image, .png or .jpg, which
becomes a mosaic. Every setting is a flag; ``--help`` lists them.

Exit status: 0 written; 2 written, but a check failed and ``report.json`` says
which; 1 nothing written, the folder is as it was, one sentence says why (or a
traceback, if it is a bug); 130, 143 and 129 nothing written, as Ctrl-C, SIGTERM
or SIGHUP stopped it. As ``blender -b -P`` ends with 0 after an error in
Python, this file catches, shows and turns every exception into a 1 by itself.
"""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts.stopping import Stop, Stopped, forgive_streams  # noqa: E402 - found through the line above

stop = Stop()
if __name__ == "__main__":
    # before the imports, which take seconds
    forgive_streams()
    stop.listen()

try:
    import argparse
    import time
    import tomllib
    import traceback
    from collections.abc import Callable, Iterator, Sequence
    from contextlib import AbstractContextManager, ExitStack, contextmanager
    from dataclasses import Field, fields, replace
    from functools import partial
    from typing import Any, Final, NamedTuple, NoReturn, Self, TextIO, get_args

    import bpy

    from legorize_addon.core.build import Build, Finished
    from legorize_addon.core.edits import NO_EDITS, read_edits
    from legorize_addon.core.errors import BuildError, LegorizeError, SettingsError, enough_memory
    from legorize_addon.core.existing import Existing, StepsFrom
    from legorize_addon.core.files.folder import new_folder, temporary_of, writing
    from legorize_addon.core.files.manifest import changed
    from legorize_addon.core.files.paths import named, readable
    from legorize_addon.core.files.sources.pictures import PICTURES
    from legorize_addon.core.instructions import PAPERS, Booklet, layer_files, layer_pages
    from legorize_addon.core.ldraw.reader import SUFFIXES, read_file
    from legorize_addon.core.method import Shown, method_files
    from legorize_addon.core.model.assembly import Assembly
    from legorize_addon.core.model.bricks import Role
    from legorize_addon.core.model.catalogue import load_catalogue
    from legorize_addon.core.pipeline import judge, legorize, legorize_image
    from legorize_addon.core.presets import PRESETS, preset_values
    from legorize_addon.core.progress import Meter, Overall, Progress, duration, part
    from legorize_addon.core.report.checks import failed_checks
    from legorize_addon.core.report.outputs import CERTAIN, output_texts
    from legorize_addon.core.report.report import report
    from legorize_addon.core.report.summary import summary
    from legorize_addon.core.setting import SEPARATOR, help_text, renamed
    from legorize_addon.core.settings import Settings, choices, setting_type
    from legorize_addon.core.settings_file import read_settings, settings_text
    from legorize_addon.core.unit_bricks import said_of_feet
    from legorize_addon.core.units import MM_PER_METRE
    from legorize_addon.reading.importers import load
    from legorize_addon.reading.objects import read_rendered
    from legorize_addon.reading.pictures import load_picture
    from legorize_addon.reading.quiet import quiet
    from legorize_addon.render.contact_sheet import render_contact_sheet
    from legorize_addon.render.film import Cut, make_film, render_frames
    from legorize_addon.render.still import AZIMUTH, View, render_still
    from legorize_addon.scene.collections import clear_build
    from legorize_addon.scene.lettering import title_for
    from legorize_addon.scene.model import Source
    from legorize_addon.scene.section import AXES, Section
    from legorize_addon.scene.state import state_of
    from legorize_addon.view.colour_errors import show_colour_errors
    from legorize_addon.view.heat_map import show_heat_map
    from legorize_addon.view.method import STEPS, MethodView, show_method
    from legorize_addon.view.show_result import show_result
    from legorize_addon.view.steps import explode
    from legorize_addon.view.visibility import cut_away, roles_shown, show_layers, show_role
except ModuleNotFoundError as missing:
    print(
        f"The Python package {missing.name} is missing: install Legorize as an extension, or run python3 "
        "scripts/run.py.",
        file=sys.stderr,
    )
    sys.exit(1)

Timed = Callable[[str], AbstractContextManager[None]]
"""Announces a stage before the build, and notes its time."""

SIZES: Final = ("size_by", "width", "height", "scale", "cm", "parts", "budget")
"""Settings that exclude each other; each of the others also chooses itself in the first."""

IN_PICTURE: Final = (
    *("view", "section", "outlines", "heat_map", "colour_errors", "explode", "show_supports", "top_layer"),
)
"""Flags that only change the picture."""

LAST_FRAME: Final = 1_048_574
"""In Blender, and the first one below 0."""

MOST_PICTURES: Final = 400
"""On a contact sheet."""


MOST_FRAMES: Final = 10_000
"""Of one building step, or of a turn."""


class Taken(NamedTuple):
    """What is read, by the flags of the same names."""

    source: Path | None
    frame: int | None
    object: list[str]
    again: bool
    steps: StepsFrom | None
    edits: Path | None

    @property
    def is_bricks(self) -> bool:
        """Whether the file is a brick model."""
        return self.source is not None and self.source.suffix.lower() in SUFFIXES

    @property
    def is_picture(self) -> bool:
        """Whether the file is an image."""
        return self.source is not None and self.source.suffix.lower() in PICTURES

    def check(self) -> None:
        """Refuse flags without effect."""
        if self.is_picture and (self.object or self.frame is not None):
            raise SettingsError("An image has no animation and no objects: leave --frame and --object out.")
        if self.is_bricks and (self.object or self.frame is not None):
            raise SettingsError("--object and --frame choose from meshes: leave them out for a brick model.")
        if self.edits is not None and (self.is_bricks or self.is_picture):
            raise SettingsError("--edits are made in models of meshes: leave them out for a brick model or an image.")
        if not self.is_bricks and (self.again or self.steps):
            raise SettingsError("--again and --steps are for brick models, .ldr and .mpd: leave them out for a mesh.")


class Work(NamedTuple):
    """What a file comes to.

    Attributes
    ----------
    objects : sequence of bpy.types.Object
        What the model is made of.
    build : callable
        Makes the model, told where to report its progress.
    """

    objects: Sequence[bpy.types.Object]
    build: Callable[[Progress], Finished]


class Wanted(NamedTuple):
    """What is shown in the scene, written of it and proven for the report, by the flags of the same names."""

    render: bool
    view: View | None
    section: Section | None
    outlines: bool
    heat_map: bool
    colour_errors: bool
    explode: float
    show_supports: bool
    contact_sheet: int
    animate: int
    turntable: int
    frames: bool
    save_blend: bool
    bound: bool
    picture_of: str
    top_layer: int
    single_layer: bool
    method: bool
    trajectories: str
    instructions: bool
    layers: bool
    actual_size: bool
    paper: str
    tag: str

    @property
    def any_picture(self) -> bool:
        """Whether the scene is needed at all."""
        return bool(self.render or self.contact_sheet or self.film or self.save_blend)

    @property
    def film(self) -> bool:
        """Whether there is a film."""
        return bool(self.animate or self.turntable)

    @property
    def rendered_film(self) -> bool:
        """Whether its frames are rendered here."""
        return self.film and self.frames

    def check(self) -> None:
        """Refuse flags without effect."""
        for name in IN_PICTURE:
            drawn = self.render or (name == "outlines" and self.contact_sheet)
            if getattr(self, name) and not drawn:
                flag = name.replace("_", "-")
                raise SettingsError(f"--{flag} only changes the picture: add --render, or leave it out.")
        if self.heat_map and self.colour_errors:
            raise SettingsError("A picture has one kind of colours: leave --heat-map or --colour-errors out.")
        if self.picture_of != "model":
            self._check_step()
        if self.single_layer and not self.top_layer:
            raise SettingsError("--single-layer needs to know which one: add --top-layer.")
        if not self.frames and not (self.film and self.save_blend):
            raise SettingsError("--no-frames leaves a film to others: add --save-blend, and --animate or --turntable.")
        if self.actual_size and not self.layers:
            raise SettingsError("--actual-size only changes layer maps: add --layers, or leave it out.")

    def _check_step(self) -> None:
        """Refuse what a step of the method has not got."""
        if not self.render:
            raise SettingsError("--picture-of only changes the picture: add --render, or leave it out.")
        for name in ("heat_map", "colour_errors", "explode", "show_supports"):
            if getattr(self, name):
                flag = name.replace("_", "-")
                raise SettingsError(f"--{flag} is for the finished model: leave it or --picture-of out.")


class Parser(argparse.ArgumentParser):
    """A parser whose complaints are sentences, since a 2 as exit status means something else here."""

    def error(self, message: str) -> NoReturn:
        """Raise the complaint."""
        raise SettingsError(f"The command line is wrong: {message}.")


def main(arguments: Sequence[str]) -> int:
    """Legorize a file and return the exit status."""
    try:
        options = vars(parser().parse_args(arguments))
        out, taken = options.pop("out"), Taken(**{name: options.pop(name) for name in Taken._fields})
        only_settings = options.pop("print_settings")
        if options.pop("everything"):
            options |= {"instructions": True, "layers": True}
        wanted = Wanted(**{name: options.pop(name) for name in Wanted._fields})
        wanted.check()
        taken.check()
        if wanted.colour_errors and (taken.is_picture or taken.is_bricks):
            raise SettingsError("Only meshes have a texture to compare with: leave --colour-errors out.")
        if (wanted.method or wanted.picture_of != "model") and (taken.is_picture or taken.is_bricks):
            raise SettingsError("--method and --picture-of show how meshes are built: leave them out.")
        if wanted.bound and taken.is_picture:
            raise SettingsError("There is no bound for mosaics: leave --bound out.")
        settings = settings_of(options)
        if only_settings:
            print(settings_text(settings), end="")
            return 0
        if taken.source is None or out is None:
            raise SettingsError("The command line is wrong: it needs a file to read, IN, and a folder, --out DIR.")
        with enough_memory():
            return run(taken, out, settings, wanted)
    except LegorizeError as error:
        # a stop in the middle of an importer looks like a broken file
        if not stop.status:
            print(error, file=sys.stderr)
        return 1


def parser() -> Parser:
    """Return the parser, whose flags for settings are generated."""
    made = Parser(prog="legorize.py", description="Turn a textured mesh into a brick model.", allow_abbrev=False)
    made.add_argument(
        "source", metavar="IN", nargs="?", type=lambda text: named(text, "file"), help="file with the mesh, or an image"
    )
    made.add_argument(
        "--out", metavar="DIR", type=lambda text: named(text, "folder"),
        help="folder for the results, or a link to one; it replaces the results of an earlier run and keeps your "
             "own files",
    )  # fmt: skip
    add_source(made)
    add_pictures(made)
    add_film(made)
    add_method(made)
    add_paper(made)
    made.add_argument(
        "--bound", action="store_true",
        help=("prove for the report how many bricks any layout of the model needs at least; takes longer than the "
             "layout itself"),
    )  # fmt: skip
    made.add_argument("--tag", metavar="TEXT", default="", help="text to keep in the report, to find it again by")
    made.add_argument("--save-blend", action="store_true", help="write the scene with the bricks, build.blend")
    add_sets(made)
    sizes = made.add_mutually_exclusive_group()
    for entry in fields(Settings):
        add_flag(sizes if entry.name in SIZES else made, entry)
    return made


def add_source(made: Parser) -> None:
    """Add the flags for what is taken of the file."""
    made.add_argument(
        "--frame", metavar="N", type=frame,
        help="take the pose of this frame (default: the rest pose, or the frame at which a .blend was saved)",
    )  # fmt: skip
    made.add_argument(
        "--object", metavar="NAME", action="append", default=[],
        help="take this object, or its children if it has no surface; can be given several times (default: "
             "everything that renders show)",
    )  # fmt: skip
    made.add_argument(
        "--again", action="store_true",
        help="lay a brick model (.ldr, .mpd) again: the same cells and colours in fewer bricks",
    )  # fmt: skip
    made.add_argument(
        "--steps", choices=get_args(StepsFrom),
        help="keep the building steps of a brick model, or plan new ones with supports (default: file, if it has any)",
    )  # fmt: skip
    made.add_argument(
        "--edits", metavar="FILE", type=lambda text: named(text, "file"),
        help="JSON file with changes by hand, as a run or the panel writes it (edits.json): they are made again",
    )  # fmt: skip


def add_pictures(made: Parser) -> None:
    """Add the flags for pictures."""
    made.add_argument("--render", action="store_true", help="write a picture, render.png")
    made.add_argument(
        "--view", choices=tuple(AZIMUTH),
        help="corner from which the picture shows the model; below shows its undersides (default: front_right; with "
             "a section, the side that is cut open)",
    )  # fmt: skip
    made.add_argument(
        "--section", metavar="AXIS=SHARE", type=section,
        help="cut the model open in the picture: x=0.5 shows the half with x below the middle, seen from the cut",
    )  # fmt: skip
    made.add_argument("--outlines", action="store_true", help="draw dark lines around the bricks in the picture")
    made.add_argument(
        "--heat-map", action="store_true", help="colour each brick in the picture by the friction that it has left"
    )
    made.add_argument(
        "--colour-errors", action="store_true",
        help="colour each brick in the picture by how far its colour is from the texture (CIEDE2000): blue not at "
             "all, yellow 11, red 22 and more",
    )  # fmt: skip
    made.add_argument(
        "--explode", metavar="SHARE", type=share, default=0.0,
        help="draw the pieces of a split model apart in the picture, by a share of the model's height",
    )  # fmt: skip
    made.add_argument(
        "--show-supports", action=argparse.BooleanOptionalAction, default=False,
        help="also show temporary supports in the picture (default: the finished model)",
    )  # fmt: skip
    made.add_argument(
        "--contact-sheet", metavar="N", type=pictures, default=0,
        help="write N pictures of the building order side by side in one image, contact-sheet.png",
    )  # fmt: skip


def add_method(made: Parser) -> None:
    """Add the flags that show the steps of the method."""
    made.add_argument(
        "--method", action="store_true",
        help="write what the steps before the layout look like: trajectories and hollowing, with supports, as a map "
        "of each layer, the tree of the trajectories, and models of unit bricks, method/tree.txt and so on",
    )  # fmt: skip
    made.add_argument(
        "--trajectories", choices=get_args(Shown), default="sides",
        help="draw trajectories by their side, exterior blue and interior green, or in the colours of their bricks "
        "(default: sides)",
    )  # fmt: skip
    made.add_argument(
        "--picture-of", choices=("model", *STEPS), default="model",
        help="what the picture shows: the model, or a step of the method (default: model)",
    )  # fmt: skip
    made.add_argument(
        "--top-layer", metavar="N", type=layer_number, default=0,
        help="draw the lowest N layers in the picture (default: all)",
    )  # fmt: skip
    made.add_argument("--single-layer", action="store_true", help="draw only the highest of these layers")


def add_film(made: Parser) -> None:
    """Add the flags for moving pictures."""
    made.add_argument(
        "--animate", metavar="N", type=film_frames, nargs="?", const=12, default=0,
        help="write a film of how the model is built, frames/0001.png and so on, with N frames for each step "
             "(default: 12)",
    )  # fmt: skip
    made.add_argument(
        "--turntable", metavar="N", type=film_frames, nargs="?", const=120, default=0,
        help="write a film in which the camera goes round the model once in N frames (default: 120); after the one "
             "that --animate asks for",
    )  # fmt: skip
    made.add_argument(
        "--frames", action=argparse.BooleanOptionalAction, default=True,
        help="render the film (default); without, --save-blend keeps its scene, ready to be rendered elsewhere",
    )  # fmt: skip


def add_paper(made: Parser) -> None:
    """Add the flags for what is printed."""
    made.add_argument(
        "--instructions", action="store_true",
        help="write the booklet of the building steps, instructions.html (one file, with a page in three dimensions) "
        "and instructions.pdf",
    )  # fmt: skip
    made.add_argument("--layers", action="store_true", help="write a map of each layer, layers/001.svg and so on")
    made.add_argument(
        "--actual-size", action="store_true",
        help="draw the layer maps in the real size of the bricks, so that these can be laid on the prints",
    )  # fmt: skip
    made.add_argument(
        "--everything", action="store_true",
        help="write all that the panel's Export Everything writes: the same as --instructions --layers",
    )  # fmt: skip
    made.add_argument("--paper", choices=tuple(PAPERS), default="A4", help="size of the pages (default: A4)")


def add_sets(made: Parser) -> None:
    """Add the flags that choose many settings at once."""
    made.add_argument(
        "--preset", choices=tuple(PRESETS), help="settings that belong together, as the panel's menu Look has them"
    )
    made.add_argument(
        "--settings", metavar="FILE", type=lambda text: named(text, "file"),
        help="JSON file with settings, as --print-settings writes it, or a report.json; it changes what a preset sets, "
             "and flags change both",
    )  # fmt: skip
    made.add_argument("--print-settings", action="store_true", help="print all settings as JSON, and build nothing")


def add_flag(group: Any, entry: Field[Any]) -> None:
    """Add the flag of a setting; settings without a flag on the command line keep their default."""
    kind, words = setting_type(entry), choices(entry)
    # argparse takes % for a placeholder
    text = help_text(entry).replace("%", "%%")
    options: dict[str, Any] = {"default": argparse.SUPPRESS, "help": f"{text} (default: {entry.default})"}
    if kind is bool:
        options["action"] = argparse.BooleanOptionalAction
    elif words:
        options["choices"] = words
    elif entry.metadata["files"] > 1:
        options.update(action="append", metavar="FILE", help=f"{text} The flag can also be given several times.")
    else:
        options.update(type=whole if kind is int else kind, metavar=kind.__name__.upper())
    group.add_argument(f"--{entry.name.replace('_', '-')}", **options)
    if entry.metadata["was"]:
        earlier = f"--{entry.metadata['was'].replace('_', '-')}"
        group.add_argument(earlier, **{**options, "dest": entry.metadata["was"], "help": argparse.SUPPRESS})


def whole(text: str) -> int:
    """Return a whole number, in any form."""
    try:
        found = float(text)
    except ValueError:
        found = 0.5
    if not found.is_integer():
        raise argparse.ArgumentTypeError(f"{text!r} is no whole number")
    # an integer has more digits than a float
    return int(text) if text.strip().lstrip("+-").isdecimal() else int(found)


def section(text: str) -> Section:
    """Return the cut that a text such as x=0.5 asks for."""
    axis, _, share = text.partition("=")
    try:
        at = float(share)
    except ValueError:
        at = -1.0
    if axis not in AXES or not 0.0 <= at <= 1.0:
        raise argparse.ArgumentTypeError(
            f"{text!r} is not a section: write x, y or z, =, and a number from 0 to 1, such as x=0.5"
        )
    return Section(axis=axis, at=at)


def share(text: str) -> float:
    """Return a number from 0 to 1."""
    try:
        found = float(text)
    except ValueError:
        found = -1.0
    if not 0.0 <= found <= 1.0:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number from 0 to 1")
    return found


def frame(text: str) -> int:
    """Return the number of a frame."""
    try:
        found = int(text)
    except ValueError:
        found = LAST_FRAME + 1
    if abs(found) > LAST_FRAME:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from {-LAST_FRAME} to {LAST_FRAME}")
    return found


def pictures(text: str) -> int:
    """Return a number of pictures."""
    if not (text.isdecimal() and 1 <= int(text) <= MOST_PICTURES):
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1 to {MOST_PICTURES}")
    return int(text)


def layer_number(text: str) -> int:
    """Return the number of a layer."""
    if not (text.isdecimal() and int(text) >= 1):
        raise argparse.ArgumentTypeError(f"{text!r} is not the number of a layer, from 1")
    return int(text)


def film_frames(text: str) -> int:
    """Return a number of frames."""
    if not (text.isdecimal() and 1 <= int(text) <= MOST_FRAMES):
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1 to {MOST_FRAMES}")
    return int(text)


def settings_of(options: dict[str, Any]) -> Settings:
    """Return the settings of the preset, changed by those of the file, changed by flags; earlier names get a remark."""
    preset, file = options.pop("preset", None), options.pop("settings", None)
    layers = [preset_values(preset) if preset else {}]
    if file is not None:
        values, remarks = read_settings(text_of(readable(file)))
        layers.append(values)
        print(*remarks, sep="\n", end="\n" if remarks else "", file=sys.stderr)
    for entry in fields(Settings):
        if isinstance(options.get(entry.name), list):
            options[entry.name] = SEPARATOR.join(options[entry.name])
        if entry.metadata["was"] in options:
            options[entry.name] = options.pop(entry.metadata["was"])
            print(renamed(entry), file=sys.stderr)
    chosen: dict[str, Any] = {}
    for layer in (*layers, options):
        sizes = [name for name in SIZES[1:] if name in layer]
        chosen |= {"size_by": sizes[0], **layer} if len(sizes) == 1 else layer
    return Settings(**chosen)


def text_of(path: Path) -> str:
    """Return the text of a file."""
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise SettingsError(f"{path} is not a UTF-8 text: save it as one.") from error


def run(taken: Taken, out: Path, settings: Settings, wanted: Wanted) -> int:
    """Legorize a file into a folder."""
    source, seconds = readable(taken.source), dict[str, float]()
    # before there is a folder to clear away: a crash of an importer leaves nothing behind
    with Line(sys.stdout) as line, ExitStack() as stack:
        read = work_on_picture if taken.is_picture else work_on_bricks if taken.is_bricks else work_on_mesh
        objects, make = read(source, taken, settings, partial(timed, seconds, progress=line))
        folder = stack.enter_context(new_folder(out, names=CERTAIN))
        stop.temporary = temporary_of(folder)
        # in builds: measured without a proof at 48 to 192 studs, guessed for the proof and the pictures
        later = {
            "report": 0.03 + wanted.bound,
            "files": 0.03,
            "layer maps": 0.2 * wanted.layers,
            "method maps": 0.1 * wanted.method,
        }
        later["booklet"] = 3.0 * wanted.instructions
        later["pictures"] = float(wanted.any_picture)
        later["contact sheet"] = 0.5 * wanted.contact_sheet
        # most of the bar; how long a frame takes is known after the first ones
        later["film"] = 20.0 * wanted.rendered_film
        if wanted.rendered_film:
            line.meter.leave_open()
        built = 1 / (1 + sum(later.values()))
        build = make(part(line, 0.0, built))
        build = replace(build, timings={**seconds, **build.timings})
        rest = Overall(later, part(line, built, 1.0))
        facts = described(build, rest, with_bound=wanted.bound)
        facts |= {"tag": wanted.tag} if wanted.tag else {}
        with rest.stage("files"), writing(out):
            for name, text in output_texts(build, load_catalogue(), facts, source.stem).items():
                (folder / name).parent.mkdir(exist_ok=True)
                (folder / name).write_text(text, encoding="utf-8", newline="")
        if wanted.layers:
            with rest.stage("layer maps") as progress, writing(out):
                write_layers(build, folder / "layers", wanted, progress)
        if wanted.method:
            with rest.stage("method maps") as progress, writing(out):
                write_method(build, folder / "method", wanted, source.stem, progress)
        if wanted.instructions:
            with rest.stage("booklet") as progress, writing(out):
                write_booklet(build, folder, wanted, source.stem, progress)
        if wanted.any_picture:
            show(build, folder, wanted, Source(source.stem, objects, notes=build.notes), rest, line.meter)
        files = [path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()]
        left = [name for name in changed(out) if name not in files]
        stop.too_late()
    for name in left:
        print(f"{out / name} was kept, because it was changed after an earlier run had written it.", file=sys.stderr)
    # losses are printed too: few open the report of a run that went well
    for sentence in (*facts["notes"], *summary(facts, str(out), files)):
        print(sentence)
    for sentence in facts["failed_checks"]:
        print(sentence, file=sys.stderr)
    return 2 if facts["failed_checks"] else 0


def work_on_mesh(source: Path, taken: Taken, settings: Settings, timed: Timed) -> Work:
    """Read a mesh, to be legorized."""
    edits = NO_EDITS if taken.edits is None else read_edits(text_of(readable(taken.edits)), load_catalogue())
    with timed("import"):
        objects, left_out, up = load(source, frame=taken.frame, names=taken.object, up=settings.up)
    with timed("read"), quiet():
        mesh, remarks = read_rendered(objects, bpy.context, weight=settings.weight)

    def build(progress: Progress) -> Finished:
        """Legorize it."""
        made = legorize(mesh, replace(settings, up=up), progress, edits=edits)
        return replace(made, settings=settings, notes=(*left_out, *remarks, *made.notes))

    return Work(objects, build)


def work_on_bricks(source: Path, taken: Taken, settings: Settings, timed: Timed) -> Work:
    """Read a brick model, to be judged, or laid again."""
    with timed("import"):
        with quiet():
            bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        found = read_file(source, load_catalogue())
    given = Existing.of(found)
    return Work((), partial(_judged, given, settings, taken))


def _judged(given: Existing, settings: Settings, taken: Taken, progress: Progress) -> Finished:
    return judge(given, settings, again=taken.again, steps=taken.steps or "file", progress=progress)


def work_on_picture(source: Path, taken: Taken, settings: Settings, timed: Timed) -> Work:
    """Read an image, to become a mosaic."""
    with timed("import"):
        picture, remarks = load_picture(source)
        with quiet():
            bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)

    def build(progress: Progress) -> Finished:
        """Legorize it."""
        made = legorize_image(picture, settings, progress)
        return replace(made, notes=(*remarks, *made.notes))

    return Work((), build)


def described(build: Finished, rest: Overall, *, with_bound: bool) -> dict[str, Any]:
    """Return what the report says of a build, with the checks that failed."""
    with rest.stage("report"):
        units = {"version": version(), "mm_per_unit": mm_per_unit()}
        facts = report(build, load_catalogue(), **units, with_bound=with_bound, progress=rest)
        return facts | {"failed_checks": failed_checks(facts)}


def write_layers(build: Finished, folder: Path, wanted: Wanted, progress: Progress) -> None:
    """Write the layer maps."""
    plan, paper = build.supports, PAPERS[wanted.paper]
    options = {"temporary": plan.temporary, "paper": paper, "actual_size": wanted.actual_size, "progress": progress}
    folder.mkdir()
    for name, text in layer_files(layer_pages(plan.bricks, load_catalogue(), **options), paper):
        (folder / name).write_text(text, encoding="utf-8", newline="")


def write_method(build: Finished, folder: Path, wanted: Wanted, title: str, progress: Progress) -> None:
    """Write what shows the steps of the method."""
    if not isinstance(build, Build):
        raise TypeError("only meshes have trajectories")
    supports = Assembly(build.supports.removed, load_catalogue())
    options = {"title": title, "shown": wanted.trajectories, "catalogue": load_catalogue(), "progress": progress}
    for name, text in method_files(build.draft, supports, **options):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8", newline="")


def write_booklet(build: Finished, folder: Path, wanted: Wanted, title: str, progress: Progress) -> None:
    """Write the booklet."""
    plan, paper = build.supports, PAPERS[wanted.paper]
    name = title_for(title)
    if name.lost:
        print(name.lost, file=sys.stderr)
    made = Booklet(plan.bricks, load_catalogue(), plan.steps, temporary=plan.temporary, title=name, paper=paper,
                   remarks=said_of_feet(build.notes))  # fmt: skip
    made.write(folder / "instructions.html", folder / "instructions.pdf", progress)


class Line:
    """Progress for a reader: one line that changes on a terminal, else a line for each stage and each tenth."""

    def __init__(self, stream: TextIO) -> None:
        self._stream, self._changes = stream, stream.isatty()
        self.meter, self._last, self._width = Meter(), ("", 0.0), 0
        self._seen: set[str] = set()

    def __call__(self, stage: str, share: float) -> None:
        """Show the progress, unless it is shown already."""
        self.meter(stage, share)
        # stages that ask for parts of others by turns would fill a page with their names
        known = stage == self._last[0] if self._changes else stage in self._seen
        if known and share < self._last[1] + (0.01 if self._changes else 0.1):
            return
        self._seen.add(stage)
        left = self.meter.seconds_left
        text = f"{share:4.0%} {stage}" + (f", {duration(left)} left" if left else "")
        # blanks cover what was longer
        self._stream.write(f"\r{text:{self._width}}" if self._changes else f"{text}\n")
        self._stream.flush()
        self._last, self._width = (stage, share), len(text)

    def __enter__(self) -> Self:
        """Begin."""
        return self

    def __exit__(self, *error: object) -> None:
        """Wipe the line that changes, also for the sentence of a failure."""
        if self._changes:
            self._stream.write(f"\r{'':{self._width}}\r")
            self._stream.flush()


def show(build: Finished, folder: Path, wanted: Wanted, source: Source, rest: Overall, meter: Meter) -> None:
    """Put the bricks into the scene, and write the wanted pictures and files."""
    scene = bpy.context.scene
    with rest.stage("pictures"):
        shown = show_result(scene, build, source, mm_per_unit=mm_per_unit())
        if wanted.render:
            view = wanted.view or ("section" if wanted.section else "front_right")
            with pictured(shown, build, wanted, source.name) as pose, pose, quiet():
                render_still(scene, folder / "render.png", view=view, outlines=wanted.outlines)
    if wanted.contact_sheet:
        options = {"pictures": wanted.contact_sheet, "outlines": wanted.outlines}
        with rest.stage("contact sheet") as progress:
            path = folder / "contact-sheet.png"
            render_contact_sheet(scene, shown, path, **options, progress=progress, around=quiet)
    if wanted.film:
        film = make_film(scene, shown, Cut(wanted.animate, wanted.turntable))
        if wanted.frames:
            (folder / "frames").mkdir()
            meter.start_anew()
            with rest.stage("film") as progress:
                render_frames(film, folder / "frames", progress, around=quiet)
        # a render farm takes the scene that a file was saved with
        if wanted.save_blend and bpy.context.window:
            bpy.context.window.scene = film
    if wanted.save_blend:
        save(folder / "build.blend")


@contextmanager
def pictured(
    shown: bpy.types.Collection, build: Finished, wanted: Wanted, name: str
) -> Iterator[AbstractContextManager[None]]:
    """Yield the pose of what the picture shows: the model, or a step of the method in its place."""
    scene = bpy.context.scene
    if not isinstance(build, Build) or wanted.picture_of == "model":
        yield posed(shown, wanted)
        return
    scene.collection.children.unlink(shown)
    view = MethodView(wanted.picture_of, wanted.trajectories, beside=False)
    step = show_method(scene, build.draft, name, view=view, mm_per_unit=mm_per_unit(), detail="high")
    yield posed(step, wanted)
    clear_build(scene, step)
    scene.collection.children.link(shown)


@contextmanager
def posed(shown: bpy.types.Collection, wanted: Wanted) -> Iterator[None]:
    """Show a build as it is wanted in the picture, and then as it was before."""
    supports = wanted.show_supports and Role.SUPPORT_OUTSIDE in roles_shown(shown)
    cut_away(shown, wanted.section or Section())
    if wanted.heat_map:
        show_heat_map(shown, visible=True)
    if wanted.colour_errors:
        show_colour_errors(shown, visible=True)
    if wanted.explode:
        explode(shown, wanted.explode)
    layers = state_of(shown).layers
    show_layers(bpy.context.scene, shown, min(wanted.top_layer or layers, layers), single=wanted.single_layer)
    if supports:
        show_role(shown, Role.SUPPORT_OUTSIDE, visible=True)
    yield
    if supports:
        show_role(shown, Role.SUPPORT_OUTSIDE, visible=False)
    show_layers(bpy.context.scene, shown, layers)
    if wanted.explode:
        explode(shown, 0.0)
    if wanted.heat_map:
        show_heat_map(shown, visible=False)
    if wanted.colour_errors:
        show_colour_errors(shown, visible=False)
    cut_away(shown, Section())


def save(path: Path) -> None:
    """Write the scene, with image paths that stay valid if the file is moved."""
    named(str(path), "scene", BuildError)
    if bpy.data.filepath:
        bpy.ops.file.make_paths_absolute()
    try:
        bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True, compress=True, relative_remap=False)
    except RuntimeError as error:
        raise BuildError(f"The scene cannot be saved ({str(error).strip()}): choose another folder.") from error


@contextmanager
def timed(seconds: dict[str, float], stage: str, progress: Progress) -> Iterator[None]:
    """Announce a stage before the build, and note the processor time that it takes."""
    progress(stage, 0.0)
    start = time.process_time()
    yield
    seconds[stage] = time.process_time() - start


def mm_per_unit() -> float:
    """Return the length of a Blender unit in mm."""
    return float(bpy.context.scene.unit_settings.scale_length) * MM_PER_METRE


def version() -> str:
    """Return the version, which stands in the manifest alone."""
    return str(tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))["version"])


def own_arguments() -> list[str]:
    """Return what the command line says to this script: all after ``--`` if a Blender program runs it."""
    if "--" in sys.argv:
        return sys.argv[sys.argv.index("--") + 1 :]
    return [] if bpy.app.binary_path else sys.argv[1:]


if __name__ == "__main__":
    stop.loaded()
    try:
        status = main(own_arguments())
    except Stopped:
        status = stop.status
    except Exception:  # noqa: BLE001 - blender -b -P ends with 0 after an error
        traceback.print_exc()
        raise SystemExit(1) from None
    if stop.status:
        print("Stopped: nothing was written.", file=sys.stderr)
        stop.end()
    sys.exit(status)
