#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Builds the book: static pages that open from a folder, with search and without a network.

usage: book.py [--out FOLDER] [--bin FOLDER]

--out is build/book unless told otherwise, and its first page index.html; --bin, build/release/bin,
has the programs, whose --help is part of the book.

The book's own pages are in toolchain/book; all others are the repository's own (READMEs,
PHYSICS.md, GUARD.md, ...), taken as they are. The nav of mkdocs.yml there says which, and in what
order; a page that one of them links to comes along. A link to another file leads to its listing,
one to a header of the interface to Doxygen's page of it. Below each figure stand the command that
makes it (figures.sh) and the commit.

Anything wrong is an error: a link that leads nowhere, a figure without a command, a warning of
mkdocs or Doxygen. The same sources give the same bytes. Needs mkdocs-material, doxygen,
libjs-katex and nodejs of Debian (setup.sh test).
"""
import argparse
import fnmatch
import html
import json
import os
import pathlib
import posixpath
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
OWN = "toolchain/book"  # the book's own pages and their looks
KATEX = pathlib.Path("/usr/share/javascript/katex")
THEME = pathlib.Path("/usr/share/mkdocs/themes/material")
NEEDED = {"mkdocs": "mkdocs-material", str(THEME / "base.html"): "mkdocs-material",
          "node": "nodejs", "doxygen": "doxygen", str(KATEX / "katex.mjs"): "libjs-katex"}
# Headers with a page of Doxygen's.
INTERFACE = ["hal/hosts/c/include/stylet/stylet.h", "hal/hosts/c/include/stylet/stylet_loop.h",
             *(f"kernel/include/stylet/{name}.h" for name in
               ("kernel", "limits", "material", "organ", "status", "units"))]
PICTURES = {".svg", ".png", ".jpg"}
LANGUAGES = {".cpp": "cpp", ".h": "cpp", ".inc": "cpp", ".c": "c", ".py": "python", ".sh": "bash",
             ".toml": "toml", ".m": "matlab", ".csv": "text", ".fbs": "text"}
FENCE = re.compile(r"^( *)(```+)(.*)$")
LINK = re.compile(r"\]\(([^)\s]+)\)")
PICTURE = re.compile(r"^!\[([^\]]*)\]\(([^)\s]+)\)\n", re.M)


class Wrong(Exception):
    """What is wrong with a page, in one line."""


def lacking():
    """Debian's packages that are needed and are not there."""
    return sorted({package for what, package in NEEDED.items()
                   if not (shutil.which(what) or pathlib.Path(what).exists())})


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise Wrong(f"{words[0]}: exit code {done.returncode}\n{done.stdout}{done.stderr}".strip())
    return done.stdout


def as_of():
    """A function from a file's name to the commit it is of, with its day."""
    inside = subprocess.run(["git", "-C", ROOT, "ls-files", "--error-unmatch", "README.md"],
                            capture_output=True).returncode == 0
    version = re.search(r"project\(\w+\s+VERSION\s+([\d.]+)", (ROOT / "CMakeLists.txt").read_text())
    if not inside:  # a source archive
        return lambda name: f"version {version[1]}"
    changed = {line[3:] for line in run("git", "-C", ROOT, "status", "--porcelain",
                                        "--untracked-files=all").splitlines()}

    def commit(name):
        last = run("git", "-C", ROOT, "log", "-1", "--format=%h of %cs", "--", name).strip()
        if not last:
            return "no commit yet"
        return f"commit {last}" + (", changed since" if name in changed else "")
    return commit


def figure_commands():
    """[(pattern of figures, command that makes them)], as figures.sh lists them."""
    lines = run(ROOT / "toolchain/figures.sh", "--list").splitlines()
    return [(re.split(r"[:, ]", made.split(None, 1)[1])[0], command.strip())
            for made, command in zip(lines[::2], lines[1::2])]


def outside_code(text, change):
    """`text` with change(part) for what is neither a block nor a span of code."""
    out, part, fence = [], [], None
    for line in text.splitlines(keepends=True):
        match = FENCE.match(line)
        if fence is None and match:
            out.append(spans_apart("".join(part), change))
            part, fence = [], match[2]
            out.append(line)
        elif fence is not None:
            out.append(line)
            fence = None if line.strip() == fence else fence
        else:
            part.append(line)
    return "".join(out) + spans_apart("".join(part), change)


def spans_apart(text, change):
    """The same for spans of code; the change sees a mark in the place of each."""
    spans = []

    def keep(match):
        spans.append(match[0])
        return f"\0{len(spans) - 1}\0"
    changed = change(re.sub(r"(`+)(?!`).+?(?<!`)\1(?!`)", keep, text, flags=re.S))
    return re.sub(r"\0(\d+)\0", lambda match: spans[int(match[1])], changed)


class Book:
    def __init__(self, docs, programs):
        self.docs, self.programs = docs, programs
        self.commit, self.commands = as_of(), figure_commands()
        self.todo, self.known = [], set()

    def place(self, name):
        """Where in the book a file of the repository is."""
        if name in INTERFACE:
            stem = pathlib.PurePath(name).stem.replace("_", "__")
            return f"api/{stem}_8h.html"
        if name.endswith(".md"):
            if name == "README.md":  # mkdocs would take it for the first page
                return "project.md"
            return name.removeprefix(f"{OWN}/")
        if pathlib.PurePath(name).suffix in PICTURES:
            return name
        return f"source/{name}.md"

    def want(self, name):
        if name not in self.known:
            self.known.add(name)
            self.todo.append(name)
        return self.place(name)

    def link(self, page, target):
        """The link of a page of the repository, as one of the book; None: a folder."""
        if re.match(r"[a-z]+:|#", target):
            return target
        target, _, anchor = target.partition("#")
        name = posixpath.normpath(posixpath.join(posixpath.dirname(page), target))
        if (ROOT / name).is_dir():
            return None
        if not (ROOT / name).is_file():
            raise Wrong(f"{page}: links to {target}, which is not there")
        place = posixpath.relpath(self.want(name), posixpath.dirname(self.place(page)) or ".")
        return place + (f"#{anchor}" if anchor else "")

    def figure(self, page, match):
        name = posixpath.normpath(posixpath.join(posixpath.dirname(page), match[2]))
        command = next((command for pattern, command in self.commands
                        if fnmatch.fnmatch(name, pattern)), None)
        if command is None:
            raise Wrong(f"{page}: {name}: no command in figures.sh makes this figure")
        source = self.link(page, match[2])
        return (f'<figure markdown="0"><a href="{source}">'
                f'<img src="{source}" alt="{match[1]}"></a>\n'
                f"<figcaption>{match[1]}.<br><small>Made by <code>{command}</code>, "
                f"{self.commit(name)}.</small></figcaption></figure>\n")

    def help_text(self, match):
        program, *command = match[1].split()
        said = run(self.programs / program, *command, "--help")
        return f"```text\n{said.rstrip()}\n```\n"

    def page(self, name):
        """A page for mkdocs: links of the book, figures with their origin, formulas, comments."""
        def change(text):
            text = PICTURE.sub(lambda match: self.figure(name, match), text)
            found = [match for match in re.finditer(r"(!?)\[([^\[\]]*)\]\(([^)\s]+)\)", text)]
            for match in reversed(found):
                to = self.link(name, match[3])
                new = match[2] if to is None else f"{match[1]}[{match[2]}]({to})"
                text = text[:match.start()] + new + text[match.end():]
            # A comment of one line would take the table behind it along; GitHub ends it there.
            text = re.sub(r"^(<!--.*-->)\n(?=\S)", r"\1\n\n", text, flags=re.M)
            # GitHub begins a list without an empty line, Python-Markdown does not.
            return re.sub(r"^((?![-*|#> ]|\d+\. ).+\n)(?=(?:[-*]|1\.) )", r"\1\n", text, flags=re.M)
        text = (ROOT / name).read_text()
        text = re.sub(r"^<!-- help: (.+) -->\n", self.help_text, text, flags=re.M)
        text = re.sub(r"^```math\n(.*?)^```$", r"\n$$\n\1$$\n", text, flags=re.M | re.S)
        head = f"---\nsource: {name}\nas_of: {self.commit(name)}\n---\n"
        return head + outside_code(text, change)

    def listing(self, name):
        text = (ROOT / name).read_text()
        fence = "`" * max(4, 1 + max(map(len, re.findall(r"`+", text)), default=0))
        kind = LANGUAGES.get(pathlib.PurePath(name).suffix, "text")
        return (f"---\nsource: {name}\nas_of: {self.commit(name)}\n---\n"
                f"# {name}\n\n{fence}{kind}\n{text}\n{fence}\n")

    def write(self, names):
        """These files of the repository, and all that they link to."""
        for name in names:
            self.want(name)
        while self.todo:
            name = self.todo.pop()
            to = self.docs / self.place(name)
            to.parent.mkdir(parents=True, exist_ok=True)
            if name in INTERFACE:
                if not to.exists():
                    raise Wrong(f"{name}: Doxygen made no page {to.name} of it")
            elif to.suffix in PICTURES:
                shutil.copy(ROOT / name, to)
            else:
                to.write_text(self.page(name) if name.endswith(".md") else self.listing(name))


def named_in(nav):
    """Pages of a nav, which is a list of pages and of lists."""
    for entry in nav:
        for value in entry.values():
            yield from [value] if isinstance(value, str) else named_in(value)


def placed(nav, place):
    return [{title: place(value) if isinstance(value, str) else placed(value, place)}
            for entry in nav for title, value in entry.items()]


def doxygen(folder):
    """Doxygen's pages of the interface in `folder`/api."""
    settings = (ROOT / OWN / "Doxyfile").read_text() + "\n".join([
        f"INPUT = {OWN}/mainpage.dox {' '.join(INTERFACE)}",
        f"OUTPUT_DIRECTORY = {folder}", "HTML_OUTPUT = api",
        f"FILTER_PATTERNS = *.h={ROOT / 'toolchain/book_headers.py'}",
        f"STRIP_FROM_PATH = {ROOT}", f"HTML_EXTRA_STYLESHEET = {ROOT / OWN / 'theme/api.css'}", ""])
    done = subprocess.run(["doxygen", "-"], input=settings, cwd=ROOT, capture_output=True,
                          text=True)
    if done.returncode != 0 or done.stderr.strip():
        raise Wrong(f"doxygen warns:\n{done.stderr.strip()}")
    name = re.compile(r'(<div id="projectname">)\s*(\w+)')
    for page in (folder / "api").glob("*.html"):  # its name leads back into the book
        text = name.sub(r'\1<a href="../index.html">\2</a>', page.read_text())
        page.write_text(text)


def draw_formulas(site):
    """KaTeX's HTML in the place of formulas, so that a reader's browser has nothing to compute."""
    formula = re.compile(r'(<(span|div) class="arithmatex">)\\([(\[])(.*?)\\[)\]]</\2>', re.S)
    pages = {path: path.read_text() for path in site.rglob("*.html") if "api" not in path.parts}
    asked = [[html.unescape(match[4]), match[3] == "["] for text in pages.values()
             for match in formula.finditer(text)]
    made = iter(json.loads(run("node", ROOT / "toolchain/book_formulas.mjs", KATEX,
                               input=json.dumps(asked))))
    for path, text in pages.items():
        path.write_text(formula.sub(lambda match: f"{match[1]}{next(made)}</{match[2]}>", text))


def search_from_folder(site):
    """The index, without listings, and the text of the worker that searches it, as a script. A page
    that was opened from a folder may not fetch the one, nor start the other by its address; it may
    start it from a text."""
    worker = next((site / "assets/javascripts/workers").glob("search.*.js")).read_text()
    index = json.loads((site / "search/search_index.json").read_text())
    index["docs"] = [entry for entry in index["docs"]
                     if not entry["location"].startswith("source/")]
    (site / "search/search_index.json").write_text(json.dumps(index))
    (site / "assets/search_from_folder.js").write_text(
        f"var __search = {{index: Promise.resolve(JSON.parse({json.dumps(json.dumps(index))}))}};\n"
        f"const worker_text = {json.dumps(worker)};\n"
        "const OfFile = window.Worker;\n"
        "window.Worker = function (address) {\n"
        "  return new OfFile(address.endsWith('search.js') || /workers.search/.test(address)\n"
        "    ? URL.createObjectURL(new Blob([worker_text])) : address);\n};\n")


def build(out, programs):
    import yaml  # mkdocs has it, so it is there
    with tempfile.TemporaryDirectory(prefix="stylet-book-") as name:
        work = pathlib.Path(name)
        (work / "docs/assets").mkdir(parents=True)
        doxygen(work / "docs")
        settings = yaml.safe_load((ROOT / OWN / "mkdocs.yml").read_text())
        book = Book(work / "docs", programs)
        book.write(named_in(settings["nav"]))
        shutil.copytree(ROOT / OWN / "theme/assets", work / "docs/assets", dirs_exist_ok=True)
        (work / "docs/assets/katex").mkdir()
        shutil.copy(KATEX / "katex.min.css", work / "docs/assets/katex")
        shutil.copytree(KATEX / "fonts", work / "docs/assets/katex/fonts",
                        ignore=lambda _, names: [file for file in names
                                                 if not file.endswith(".woff2")])
        settings["nav"] = placed(settings["nav"], book.place)
        settings.update(docs_dir=str(work / "docs"), site_dir=str(work / "site"))
        settings["theme"]["custom_dir"] = str(ROOT / OWN / "theme")
        settings.setdefault("extra", {})["generator"] = False
        (work / "mkdocs.yml").write_text(yaml.safe_dump(settings, sort_keys=False))
        run("mkdocs", "build", "--strict", "--quiet", "--config-file", work / "mkdocs.yml",
            env={**os.environ, "PYTHONNOUSERSITE": "1"})
        draw_formulas(work / "site")
        search_from_folder(work / "site")
        for name in ("sitemap.xml", "sitemap.xml.gz"):  # tells the day, and of no address
            (work / "site" / name).unlink()
        shutil.rmtree(work / "site/assets/javascripts/lunr")  # of other languages
        if out.exists():
            shutil.rmtree(out)
        out.parent.mkdir(parents=True, exist_ok=True)
        shutil.move(work / "site", out)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/book")
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    options = parser.parse_args()
    if lacking():
        sys.exit(f"book.py: {', '.join(lacking())} missing; toolchain/setup.sh test installs them")
    if options.out.exists() and not (options.out / "search/search_index.json").exists():
        sys.exit(f"{options.out}: is there and is no book: give a folder that may be replaced")
    if not (options.bin / "stylet").exists() or not (options.bin / "stylet-organ").exists():
        sys.exit(f"{options.bin}: has no stylet and stylet-organ: build them, or the target `book`")
    try:
        build(options.out.resolve(), options.bin.resolve())
    except Wrong as wrong:
        sys.exit(f"book.py: {wrong}")
    print(f"wrote {options.out / 'index.html'}")


if __name__ == "__main__":
    main()
