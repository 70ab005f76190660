"""Validates messages of the server against a strict copy of data/schema/monitor-v1.schema.json: objects have
no additional properties, robot and workcell conform to the schemas of their files, and all members are
required unless the client has selected `fields`. Validators are compiled at first use, one per definition;
they are fast enough for the hundred thousand messages of the lockstep tests."""

import copy
import functools
import json
import os
import pathlib

import fastjsonschema

ROOT = pathlib.Path(os.environ.get("XR3_ROOT", pathlib.Path(__file__).parents[2]))
FOLDER = ROOT / "data/schema"
ALWAYS = ["op", "cell", "epoch", "seq", "tick"]  # present for every selection of `fields`
SOMETIMES = {("state", "device"), ("state_members", "device"),  # only with --serial
             *((op, "past") for op in ("state", "image", "display", "model"))}  # only in the answer to a look
CHOOSABLE = "state_members"  # the state inside a result, where `fields` selects all members


def load(name):
    return json.loads((FOLDER / f"{name}.schema.json").read_text(encoding="utf-8"))


def closed(schema):
    """A copy in which no object may have a member that the schema does not name."""
    if isinstance(schema, list):
        return [closed(each) for each in schema]
    if not isinstance(schema, dict):
        return schema
    copied = {name: closed(value) for name, value in schema.items()}
    if schema.get("type") == "object" and isinstance(schema.get("properties"), dict):
        copied["additionalProperties"] = False
    return copied


def file_schema(kind):
    """The schema of a data file, as one definition."""
    text = json.dumps(load(kind)).replace("#/definitions/", f"#/$defs/{kind}_file/definitions/")
    schema = json.loads(text)
    del schema["$schema"]
    return schema


@functools.cache
def definitions(is_whole):
    """The strict definitions. is_whole: members that `fields` may omit are required."""
    found = closed(load("monitor-v1")["$defs"])
    for kind in "robot", "workcell":
        found[f"{kind}_file"] = file_schema(kind)
    if is_whole:
        for name, definition in found.items():
            if definition.get("required") == ALWAYS or name == CHOOSABLE:
                definition["required"] = [each for each in definition["properties"]
                                          if each != "id" and (name, each) not in SOMETIMES]
    return found


@functools.cache
def validator(name, is_whole):
    """A function that raises JsonSchemaValueException if its argument does not match the definition."""
    return fastjsonschema.compile({"$ref": f"#/$defs/{name}", "$defs": copy.deepcopy(definitions(is_whole))})


def definition_of(message):
    """The name of the most specific definition for a message, because it gives the most precise error."""
    op = message.get("op") if isinstance(message, dict) else None
    if op == "event" and f"event_{message.get('event')}" in definitions(True):
        return f"event_{message['event']}"
    if op == "result":
        return "result_ok" if message.get("ok") is True else "result_error"
    return op if op in MESSAGES else "hello"


MESSAGES = [choice["$ref"].rpartition("/")[2] for choice in load("monitor-v1")["anyOf"]]


def check_as(name, value, is_whole=True):
    """Fails unless the value matches the definition."""
    try:
        validator(name, is_whole)(value)
    except fastjsonschema.JsonSchemaValueException as error:
        text = json.dumps(value)
        raise AssertionError(f"not a valid {name} (monitor-v1.schema.json): {error.message}\n{text[:2000]}") from error


def check(message, is_whole=True):
    """Fails unless the server's message matches the strict schema; returns it. is_whole=False: the client
    has selected `fields`."""
    check_as(definition_of(message), message, is_whole)
    return message


def check_value(fn, value, is_whole=True):
    """Fails unless the value is a valid result of the call; returns it."""
    name = f"value_{fn}"
    check_as(name if name in definitions(True) else "value_call", value, is_whole)
    return value


def messages(lines):
    """The messages in JSON lines, each of them checked."""
    return [check(json.loads(line)) for line in lines.splitlines()]
