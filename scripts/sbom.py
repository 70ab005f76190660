"""Prints the list of components of a release as SPDX 2.3 in JSON. Standard input: the lines of scripts/components.
Usage: sbom.py VERSION COMMIT SECONDS, the time of the commit since 1970."""

import json
import re
import sys
import time


def package(name, version, licence):
    return {"SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name), "name": name, "versionInfo": version,
            "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "licenseConcluded": licence,
            "licenseDeclared": licence, "copyrightText": "NOASSERTION"}


def document(version, commit, seconds, components):
    xr3 = package("xr3", version, "MIT")
    packages = [package(name, number, licence) for name, number, licence in components]
    relations = [("SPDXRef-DOCUMENT", "DESCRIBES", xr3["SPDXID"])]
    relations += [(xr3["SPDXID"], "CONTAINS", each["SPDXID"]) for each in packages]
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
            "name": f"xr3-{version}", "documentNamespace": f"urn:xr3:{version}:{commit}",
            "creationInfo": {"created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(seconds)),
                             "creators": ["Tool: xr3 scripts/sbom.py"]},
            "packages": [xr3, *packages],
            "relationships": [{"spdxElementId": a, "relationshipType": kind, "relatedSpdxElement": b}
                              for a, kind, b in relations]}


def main(version, commit, seconds):
    rows = [line.rstrip("\n").split("\t") for line in sys.stdin]
    print(json.dumps(document(version, commit, int(seconds), [row[:3] for row in rows]), indent=2))


if __name__ == "__main__":
    main(*sys.argv[1:])
