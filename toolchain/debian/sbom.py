#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What a package is made of, as SPDX 2.3: the Debian packages of the libraries that its programs
load, and of the headers that went into them, which is also how libraries without a file of their
own (templates) come in. Read from the programs, from what the compiler noted (ninja -t deps) and
from dpkg.

usage: sbom.py BUILD NAME VERSION LICENCE FOLDER OBJECTS...    prints the document; FOLDER holds
what is installed, OBJECTS are the folders of BUILD whose objects it was linked from
"""
import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

AT_ONCE = 1000  # paths in one call of dpkg-query; the kernel limits a command's length


def output(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True,
                          text=True, env={**os.environ, "LC_ALL": "C.UTF-8"}).stdout


def programs(folder):
    for path in sorted(pathlib.Path(folder).rglob("*")):
        if path.is_file() and not path.is_symlink() and path.open("rb").read(4) == b"\x7fELF":
            yield path


def loaded(program):
    """Files of the libraries that the program names itself, not those that they need in turn."""
    names = re.findall(r"\(NEEDED\).*\[(\S+)\]", output("readelf", "-d", program))
    places = {}
    for name, place in re.findall(r"^\s*(\S+) .*=> (\S+)$", output("/sbin/ldconfig", "-p"), re.M):
        places.setdefault(name, place)  # this processor's come before those of other kinds
    return [places[name] for name in names if name in places]


def headers(build, folders):
    """Headers of the system in objects below these folders of the build."""
    found, wanted = set(), False
    for line in output("ninja", "-C", build, "-t", "deps").splitlines():
        if not line.startswith(" "):
            wanted = line.startswith(tuple(folders))
        elif wanted and line.strip().startswith("/usr/"):
            found.add(os.path.normpath(line.strip()))
    return sorted(found)


def owners(paths):
    """Debian's packages with these files; one that no package owns is left out."""
    found = set()
    # dpkg knows a file of a merged /usr by the name its package has for it.
    names = sorted({path.removeprefix("/usr") for path in paths} |
                   {"/usr" + path.removeprefix("/usr") for path in paths})
    for first in range(0, len(names), AT_ONCE):
        done = subprocess.run(["dpkg-query", "-S", *names[first:first + AT_ONCE]],
                              capture_output=True, text=True)
        found |= {line.split(":")[0] for line in done.stdout.splitlines()
                  if not line.startswith("diversion")}
    return sorted(found)


def licences(package):
    """The short names in Debian's copyright file, as it writes them."""
    path = pathlib.Path("/usr/share/doc") / package / "copyright"
    text = path.read_text(errors="replace") if path.exists() else ""
    return sorted(set(re.findall(r"^License: *(\S.*?)\s*$", text, re.M)))


def described(package):
    version, architecture, source = output(
        "dpkg-query", "-W", "-f=${Version}\\n${Architecture}\\n${source:Package}\\n",
        package).split("\n")[:3]
    names = licences(package)
    return {
        "SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", package),
        "name": package, "versionInfo": version, "supplier": "Organization: Debian",
        "sourceInfo": f"built from Debian's source package {source}",
        "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
        "licenseConcluded": "NOASSERTION", "licenseDeclared": "NOASSERTION",
        "licenseComments": "in Debian's words: " + (", ".join(names) or "see its copyright file"),
        "copyrightText": "NOASSERTION",
        "externalRefs": [{
            "referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
            "referenceLocator": f"pkg:deb/debian/{package}@{version}?arch={architecture}"}]}


def document(build, name, version, licence, folder, objects):
    linked = owners(sorted({path for program in programs(folder) for path in loaded(program)}))
    read = owners(headers(build, objects)) if objects else []
    parts = [described(package) for package in sorted({*linked, *read})]
    own = {"SPDXID": "SPDXRef-" + name, "name": name, "versionInfo": version,
           "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
           "licenseConcluded": licence, "licenseDeclared": licence,
           "copyrightText": "NOASSERTION"}
    relations = [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES",
                  "relatedSpdxElement": own["SPDXID"]}]
    for part in parts:
        if part["name"] in linked:
            relations.append({"spdxElementId": own["SPDXID"], "relationshipType": "DYNAMIC_LINK",
                              "relatedSpdxElement": part["SPDXID"]})
        if part["name"] in read:
            relations.append({"spdxElementId": part["SPDXID"],
                              "relationshipType": "BUILD_DEPENDENCY_OF",
                              "relatedSpdxElement": own["SPDXID"]})
    day = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]),
                                          datetime.timezone.utc)
    content = {"packages": [own, *parts], "relationships": relations}
    digest = hashlib.sha256(json.dumps(content).encode()).hexdigest()[:16]
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
            "name": f"{name}-{version}",
            "documentNamespace": f"https://spdx.org/spdxdocs/{name}-{version}-{digest}",
            "creationInfo": {"created": day.strftime("%Y-%m-%dT%H:%M:%SZ"),
                             "creators": ["Tool: stylet-sbom"]},
            **content}


if __name__ == "__main__":
    if len(sys.argv) < 6:
        sys.exit(__doc__)
    print(json.dumps(document(*sys.argv[1:6], sys.argv[6:]), indent=1))
