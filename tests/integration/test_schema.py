"""The schemas of data/schema: the shipped files conform, and the broken files of tests/data/broken do not,
unless their fault cannot be expressed in a schema. The monitor's schema: the messages in docs/ conform, and
no mutation of such a message conforms to the strict copy (monitor_schema.py)."""

import copy
import json
import os
import pathlib
import re
import sys

import jsonschema

import monitor_schema

ROOT = pathlib.Path(os.environ.get("XR3_ROOT", pathlib.Path(__file__).parents[2]))

# The faults of these files are contradictions between values, which only the loader can find.
BEYOND_A_SCHEMA = {
    "robot-carousel-clash", "robot-coupled-switch", "robot-hard-home-in-region", "robot-home-in-region",
    "robot-home-inch",
    "robot-labels-twice", "robot-masks-clash", "robot-names", "robot-switch-beyond", "robot-too-long",
    "robot-too-many-counts",
    "fault-members", "fault-names", "fault-triggers",
    "goal-places",
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
    """The JSON of a data file without its comment lines."""
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


VALIDATORS = {kind: validator(kind) for kind in ("robot", "workcell", "fault", "goal")}


def errors_of(path, kind):
    """The findings of the schema in a file, one line each."""
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
    """Every command of data/commands.json has a form, an effect, a source, and ordered ranges, and
    docs/protocol.md describes it."""
    commands = read(ROOT / "data/commands.json")
    reference = (ROOT / "docs/protocol.md").read_text(encoding="utf-8").replace(r"\|", "|")
    forms = set()
    for group in ("motion", "switches_and_lines", "environment"):
        for command in commands[group]:
            assert command["form"] not in forms, command["form"]
            forms.add(command["form"])
            assert command["effect"] and command["example"] and command["source"], command["form"]
            documented = (command["form"], command["form"].replace("n", "1"))
            assert any(f"`{form}`" in reference for form in documented), command["form"]
            for argument in command["arguments"]:
                if isinstance(argument.get("max"), int):
                    assert argument["min"] < argument["max"], command["form"]
    assert forms


# --- The marks of docs/data-files.md.

# The tables of members, in their order: the schema and its definition; None is the file itself.
TABLES = [("robot", None), ("robot", "joint"), ("robot", "tool"), ("robot", "carousel"),
          ("workcell", None), ("workcell", "block"), ("workcell", "camera")]


def tables_of_members():
    """For every table of docs/data-files.md whose first column is `member`: the first cells of its rows."""
    tables = []
    for line in (ROOT / "docs/data-files.md").read_text(encoding="utf-8").splitlines():
        if line.startswith("| member |"):
            tables.append([])
            is_inside = True
        elif not line.startswith("|"):
            is_inside = False
        elif is_inside and not line.startswith("|--"):
            tables[-1].append(line.split("|")[1])
    return tables


def check_marks():
    """docs/data-files.md names every member of the schemas, and marks those that may be omitted."""
    tables = tables_of_members()
    assert len(tables) == len(TABLES), f"{len(tables)} tables of members"
    for (kind, definition), cells in zip(TABLES, tables):
        schema = read(ROOT / f"data/schema/{kind}.schema.json")
        wanted = schema["definitions"].get(definition, schema["properties"].get(definition)) if definition else schema
        marked = {name: bool(mark) for cell in cells for name, mark in re.findall(r"`(\w+)`( ○)?", cell)}
        assert set(marked) == set(wanted["properties"]), (kind, definition, set(marked) ^ set(wanted["properties"]))
        optional = {name for name, is_optional in marked.items() if is_optional}
        assert optional == set(marked) - set(wanted["required"]), (kind, definition, optional)


# --- The monitor port.

MESSAGE = re.compile(r'\{"(?:op|error)"')


def shown_messages():
    """(file, object) of every complete message in a code fence of docs/."""
    for path in sorted((ROOT / "docs").glob("*.md")):
        for block in re.findall(r"```.*?\n(.*?)```", path.read_text(encoding="utf-8"), re.DOTALL):
            if "\n> " in block:  # in a dialogue, requests may be invalid on purpose
                block = "\n".join(line for line in block.splitlines() if line.startswith("< "))
            for match in MESSAGE.finditer(block):
                text = block[match.start():]
                try:
                    yield path.name, json.JSONDecoder().raw_decode(text)[0]
                except json.JSONDecodeError:
                    assert "..." in text.partition("\n")[0], f"{path.name}: {text[:200]}"


def check_monitor_examples():
    schema = monitor_schema.load("monitor-v1")
    jsonschema.Draft202012Validator.check_schema(schema)
    served = jsonschema.Draft202012Validator(schema)
    requests = jsonschema.Draft202012Validator({"$ref": "#/$defs/request", "$defs": schema["$defs"]})
    answers = 0
    for name, message in shown_messages():
        if "error" in message and "op" not in message:
            continue  # an error of HTTP
        if message["op"] in monitor_schema.MESSAGES:
            monitor_schema.check(message, is_whole=False)
            served.validate(message)
            served.validate({**message, "added_later": 1})
            check_mutations(name, message)
            answers += 1
        else:
            requests.validate(message)
    assert answers > 60, answers


def check_mutations(name, message):
    """Checks that the strict schema rejects the message with an additional member, without a member of the
    envelope, and with a member of another type."""
    wrong = [{**message, "added_later": 1}]
    needed = set(message) - {"id"} if message["op"] in ("hello", "result", "lag", "bye") else set(monitor_schema.ALWAYS)
    for member in message:
        if member in needed:
            wrong.append({each: message[each] for each in message if each != member})
        wrong.append({**copy.deepcopy(message), member: {"nobody": "expects this"}})
    for mutated in wrong:
        try:
            monitor_schema.check(mutated, is_whole=False)
        except AssertionError:
            continue
        raise AssertionError(f"{name}: {mutated} conforms to the strict schema")


if __name__ == "__main__":
    check_shipped()
    check_broken()
    check_commands()
    check_marks()
    check_monitor_examples()
    sys.exit(0)
