"""The schemas of data/schema against the shipped files, which conform, and the broken ones of
tests/data/broken, which do not wherever a schema can tell."""

import json
import os
import pathlib
import sys

import jsonschema

ROOT = pathlib.Path(os.environ.get("XR3_ROOT", pathlib.Path(__file__).parents[2]))

# Broken in ways that only the loader can see: how two values fit together.
BEYOND_A_SCHEMA = {
    "robot-coupled-switch", "robot-hard-home-in-region", "robot-home-in-region", "robot-home-inch",
    "robot-masks-clash", "robot-names", "robot-switch-beyond", "robot-too-long",
    "robot-too-many-counts",
    "workcell-camera-low", "workcell-camera-reached", "workcell-names", "workcell-surface",
}


class NotJson(Exception):
    pass


def once_each(pairs):
    names = [name for name, _ in pairs]
    if len(set(names)) < len(names):
        raise NotJson("a member is given twice")
    return dict(pairs)


def refuse(word):
    raise NotJson(word)


def read(path):
    """The JSON of a data file, its comment lines taken out."""
    lines = path.read_text(encoding="utf-8").splitlines()
    text = "\n".join("" if line.lstrip().startswith("*") else line for line in lines)
    try:
        return json.loads(text, object_pairs_hook=once_each, parse_constant=refuse)
    except json.JSONDecodeError as error:
        raise NotJson(str(error)) from error


def validator(kind):
    schema = read(ROOT / f"data/schema/{kind}.schema.json")
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


VALIDATORS = {kind: validator(kind) for kind in ("robot", "workcell")}


def errors_of(path, kind):
    """What the schema finds in a file, a line each."""
    try:
        found = VALIDATORS[kind].iter_errors(read(path))
        return [f"/{'/'.join(map(str, error.absolute_path))}: {error.message}" for error in found]
    except NotJson as error:
        return [str(error)]


def check_shipped():
    for kind in VALIDATORS:
        paths = sorted((ROOT / f"data/{kind}s").glob("*.json"))
        assert paths, f"no {kind} files"
        for path in paths:
            errors = errors_of(path, kind)
            assert not errors, f"{path}: {errors}"


def check_broken():
    for path in sorted((ROOT / "tests/data/broken").glob("*.json")):
        kinds = [kind for kind in VALIDATORS if path.stem.startswith(kind)] or list(VALIDATORS)
        for kind in kinds:
            errors = errors_of(path, kind)
            if path.stem in BEYOND_A_SCHEMA:
                assert not errors, f"{path.name} breaks the schema after all: {errors}"
            else:
                assert errors, f"{path.name} conforms to the {kind} schema"


def check_commands():
    """Every command of data/commands.json has a form, an effect, a source, and ordered ranges."""
    commands = read(ROOT / "data/commands.json")
    forms = set()
    for group in ("motion", "switches_and_lines", "environment"):
        for command in commands[group]:
            assert command["form"] not in forms, command["form"]
            forms.add(command["form"])
            assert command["effect"] and command["example"] and command["source"], command["form"]
            for argument in command["arguments"]:
                if isinstance(argument.get("max"), int):
                    assert argument["min"] < argument["max"], command["form"]
    assert len(forms) == 26, len(forms)


if __name__ == "__main__":
    check_shipped()
    check_broken()
    check_commands()
    sys.exit(0)
