"""Checks JUnit files: their structure by the rules of the schema junit-10 of Jenkins' xunit plugin, their counts, and that
the names of their tests are unique, as GitLab needs it."""

import collections
import re
import xml.etree.ElementTree

# Elements: the attributes that each must have, those that it may have, its children, and whether it has text.
ELEMENTS = {
    "testsuites": ("", "name time tests failures errors", "testsuite", False),
    "testsuite": ("name tests failures errors", "group time skipped timestamp hostname id package file log url",
                  "testsuite properties testcase system-out system-err", False),
    "properties": ("", "", "property", False),
    "property": ("name value", "", "", False),
    "testcase": ("name", "time classname group",
                 "skipped error failure rerunFailure rerunError flakyFailure flakyError system-out system-err", False),
    **dict.fromkeys(("skipped", "error", "failure"), ("", "type message", "", True)),
    **dict.fromkeys(("system-out", "system-err"), ("", "", "", True)),
}
SECONDS = re.compile(r"(([0-9]{0,3},)*[0-9]{3}|[0-9]{0,3})*(\.[0-9]*)?")
COUNTED = {"failures": "failure", "errors": "error", "skipped": "skipped"}


def structure_errors(element, parents=()):
    """Errors in the structure of an element and its children, a line each."""
    place = "/".join([*parents, element.tag])
    needed, allowed, children, has_text = ELEMENTS[element.tag]
    names = set(element.attrib)
    yield from (f"{place}: no attribute {name}" for name in set(needed.split()) - names)
    yield from (f"{place}: attribute {name}" for name in names - set(needed.split()) - set(allowed.split()))
    if not SECONDS.fullmatch(element.get("time", "")):
        yield f"{place}: time {element.get('time')}"
    if not has_text and (element.text or "").strip() or (element.tail or "").strip():
        yield f"{place}: text"
    for child in element:
        if child.tag not in children.split():
            yield f"{place}: child {child.tag}"
        else:
            yield from structure_errors(child, [*parents, element.tag])


def count_errors(suite):
    """Wrong counts of a suite, a line each."""
    cases = suite.findall("testcase")
    found = {"tests": len(cases), **{name: len(suite.findall(f"testcase/{tag}")) for name, tag in COUNTED.items()}}
    yield from (f"{suite.get('name')}: {name} {suite.get(name)}, not {count}"
                for name, count in found.items() if suite.get(name) != str(count))


def read(path):
    """(the suites of a file, all errors in it)."""
    root = xml.etree.ElementTree.parse(path).getroot()
    errors = [*([] if root.tag == "testsuites" else [f"the root is {root.tag}"]), *structure_errors(root)]
    errors += [error for suite in root for error in count_errors(suite)]
    names = collections.Counter((case.get("classname"), case.get("name")) for case in root.iter("testcase"))
    return list(root), errors + [f"{count} tests are {name}" for name, count in names.items() if count > 1]
