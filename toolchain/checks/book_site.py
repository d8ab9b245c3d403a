#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Every link of a built book leads somewhere, to the very heading, and no page asks another host
for anything. Links to other hosts, which a reader may follow, are only listed with --outside.

usage: book_site.py FOLDER [--outside]
"""
import html.parser
import pathlib
import re
import sys
import urllib.parse

LOADED = {"img": "src", "script": "src", "link": "href", "iframe": "src", "source": "src"}
OUTSIDE = re.compile(r"^(?:[a-z]+:)?//|^[a-z]+:")
# Names of the file formats' inventors, which nothing fetches.
NAMESPACES = ("http://www.w3.org/",)


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.names, self.links, self.loads = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.names |= {values[key] for key in ("id", "name") if values.get(key)}
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        if values.get(LOADED.get(tag)):
            self.loads.append(values[LOADED[tag]])


def faults(site, outside=None):
    pages = {path: Page(path.read_text(errors="replace")) for path in site.rglob("*.html")}
    if not pages:
        yield f"{site}: has no pages"
    for path, page in sorted(pages.items()):
        name = path.relative_to(site)
        for address in page.loads + page.links:
            loaded = address in page.loads
            if OUTSIDE.match(address):
                if loaded and not address.startswith(("data:", "javascript:")):
                    yield f"{name}: loads {address}"
                elif outside is not None:
                    outside.add(address)
                continue
            target, _, anchor = address.partition("#")
            if target.startswith("/") or target == "." and path.name == "404.html":
                if path.name != "404.html":  # which a server gives out at any address
                    yield f"{name}: {address} is for a server"
                continue
            file = (path.parent / urllib.parse.unquote(target.partition("?")[0])).resolve()
            file = path if not target else file / "index.html" if file.is_dir() else file
            if not file.exists():
                yield f"{name}: {address} is not there"
            elif anchor and file in pages and not anchor.startswith("__"):  # the theme's own
                if urllib.parse.unquote(anchor) not in pages[file].names:
                    yield f"{name}: {address}: no such heading"
    for path in sorted(site.rglob("*.css")):
        for address in re.findall(r"(?:url\(|@import )[\"']?([^\"')]+)", path.read_text()):
            if OUTSIDE.match(address) and not address.startswith(("data:", *NAMESPACES)):
                yield f"{path.relative_to(site)}: loads {address}"


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--outside"]):
        sys.exit("usage: book_site.py FOLDER [--outside]")
    seen = set()
    found = list(faults(pathlib.Path(sys.argv[1]).resolve(), seen))
    print("\n".join(found + (sorted(seen) if sys.argv[2:] else [])))
    sys.exit(bool(found))
