"""Every message that a test receives, against a strict copy of data/schema/monitor-v1.schema.json: there
every object is closed, robot and workcell are those of their files' schemas, and where a client has
not chosen `fields`, every member is there. A validator is compiled at its first use; with its
definition it is cheap enough for the hundred thousand messages of the lockstep tests."""

import copy
import functools
import json
import os
import pathlib

import fastjsonschema

ROOT = pathlib.Path(os.environ.get("XR3_ROOT", pathlib.Path(__file__).parents[2]))
FOLDER = ROOT / "data/schema"
ALWAYS = ["op", "cell", "epoch", "seq", "tick"]  # come whatever a client chooses
CHOOSABLE = "state_members"  # of a state inside a result; there nothing comes always


def load(name):
    return json.loads((FOLDER / f"{name}.schema.json").read_text(encoding="utf-8"))


def closed(schema):
    """A copy in which no object takes a member that the schema does not name."""
    if isinstance(schema, list):
        return [closed(each) for each in schema]
    if not isinstance(schema, dict):
        return schema
    copied = {name: closed(value) for name, value in schema.items()}
    if schema.get("type") == "object" and isinstance(schema.get("properties"), dict):
        copied["additionalProperties"] = False
    return copied


def file_schema(kind):
    """The schema of a data file, as a definition of its own."""
    text = json.dumps(load(kind)).replace("#/definitions/", f"#/$defs/{kind}_file/definitions/")
    schema = json.loads(text)
    del schema["$schema"]
    return schema


@functools.cache
def definitions(is_whole):
    """The strict definitions; whole: with every member required that may be left out by `fields`."""
    found = closed(load("monitor-v1")["$defs"])
    for kind in "robot", "workcell":
        found[f"{kind}_file"] = file_schema(kind)
    if is_whole:
        for name, definition in found.items():
            if definition.get("required") == ALWAYS or name == CHOOSABLE:
                definition["required"] = [each for each in definition["properties"] if each != "id"]
    return found


@functools.cache
def validator(name, is_whole):
    """A function that raises JsonSchemaValueException, of one definition."""
    return fastjsonschema.compile({"$ref": f"#/$defs/{name}", "$defs": copy.deepcopy(definitions(is_whole))})


def definition_of(message):
    """The narrowest definition that a message must fit: what is wrong is then said in its words."""
    op = message.get("op") if isinstance(message, dict) else None
    if op == "event" and f"event_{message.get('event')}" in definitions(True):
        return f"event_{message['event']}"
    if op == "result":
        return "result_ok" if message.get("ok") is True else "result_error"
    return op if op in MESSAGES else "hello"


MESSAGES = [choice["$ref"].rpartition("/")[2] for choice in load("monitor-v1")["anyOf"]]


def check_as(name, value, is_whole=True):
    """Fails unless the value fits the definition."""
    try:
        validator(name, is_whole)(value)
    except fastjsonschema.JsonSchemaValueException as error:
        text = json.dumps(value)
        raise AssertionError(f"no {name} of monitor-v1.schema.json: {error.message}\n{text[:2000]}") from error


def check(message, is_whole=True):
    """Fails unless the message of the server is as the schema says, and nothing more. Not whole: the
    client has chosen `fields`."""
    check_as(definition_of(message), message, is_whole)
    return message


def check_value(fn, value, is_whole=True):
    """Fails unless this is what a call gives back."""
    name = f"value_{fn}"
    check_as(name if name in definitions(True) else "value_call", value, is_whole)
    return value


def messages(lines):
    """The messages of JSON lines as they came over the wire; each is checked."""
    return [check(json.loads(line)) for line in lines.splitlines()]
