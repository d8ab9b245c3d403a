# SPDX-License-Identifier: Apache-2.0
"""A minimal Debian in a folder, from this machine's own mirror."""
import os
import pathlib
import re
import shutil
import subprocess

SUITE = "bookworm"
SAID_OFFLINE = re.compile("Temporary failure|Could not resolve|Failed getting release|"
                          "Couldn't download|Connection (failed|timed out|refused)")
# Left out: folders of the running system, what tests put there, and the cache of man's pages.
NOT_OF_PACKAGES = ("/proc/", "/sys/", "/dev/", "/tmp/", "/var/cache/man/")


class Missing(Exception):
    """What this machine lacks to make such a Debian."""


def run(*command, **more):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, **more)


def mirror():
    """The mirror of apt, which is near or the only one; otherwise debootstrap's own."""
    said = run("apt-get", "indextargets", "--format", "$(REPO_URI)", "Created-By: Packages",
               f"Codename: {SUITE}", "Component: main").stdout.split()
    return [uri for uri in said if uri.startswith(("http://", "https://", "file:"))][:1]


def proxies():
    """apt's proxy, for debootstrap and for apt inside."""
    found = {}
    for scheme in ("http", "https"):
        proxy = run("apt-config", "--format", "%v", "dump", f"Acquire::{scheme}::Proxy").stdout
        proxy = proxy.strip() or os.environ.get(f"{scheme}_proxy", "")
        if proxy:
            found[f"{scheme}_proxy"] = proxy
    return found


class CleanRoot:
    def __init__(self, folder):
        for program in ("debootstrap", "unshare", "chroot"):
            if shutil.which(program) is None:
                raise Missing(f"{program} is not installed")
        if os.geteuid() != 0 or run("unshare", "--mount", "--pid", "--fork", "true").returncode:
            raise Missing("needs root that may mount")
        self.path = pathlib.Path(folder)
        self.environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/tmp",
                            "LC_ALL": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive", **proxies()}
        done = run("debootstrap", "--variant=minbase", SUITE, self.path, *mirror(),
                   env={**os.environ, **proxies()})
        if done.returncode != 0:
            said = done.stdout + done.stderr
            if SAID_OFFLINE.search(said):
                raise Missing("no network: Debian's mirror cannot be reached")
            raise AssertionError(said[-4000:])
        for name in ("resolv.conf", "hosts"):
            shutil.copy(f"/etc/{name}", self.path / "etc")

    def inside(self, *command, network=True, cwd="/tmp"):
        """Output of a command there, which must succeed. It has a /proc, which is removed
        afterwards."""
        lonely = [] if network else ["--net"]
        done = run("unshare", "--mount", "--pid", "--fork", *lonely,
                   f"--mount-proc={self.path}/proc", "chroot", self.path, "env", "-C", cwd,
                   *command, env=self.environment)
        if done.returncode != 0:
            raise AssertionError(f"{command}: exit code {done.returncode}\n{done.stdout[-4000:]}"
                                 f"{done.stderr[-4000:]}")
        return done.stdout

    def install(self, *packages, recommended=False):
        words = [] if recommended else ["--no-install-recommends"]
        self.inside("apt-get", "install", "-y", *words, *packages)

    def copy(self, source, place="/tmp"):
        """Copies a file or a folder, into a folder there."""
        folder = self.path / place.lstrip("/")
        folder.mkdir(parents=True, exist_ok=True)
        if pathlib.Path(source).is_dir():
            shutil.copytree(source, folder / pathlib.Path(source).name,
                            ignore=shutil.ignore_patterns("__pycache__", "build"))
        else:
            shutil.copy(source, folder)

    def listing(self):
        found = {"/" + str(path.relative_to(self.path)) for path in self.path.rglob("*")}
        return {path for path in found if not path.startswith(NOT_OF_PACKAGES)}
