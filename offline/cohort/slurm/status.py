#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What Snakemake asks about a job: running, success or failed.

usage: status.py JOB
"""
import re
import subprocess
import sys

WAITING = {"PENDING", "RUNNING", "COMPLETING", "CONFIGURING", "SUSPENDED", "REQUEUED", "RESIZING",
           "SIGNALING", "STAGE_OUT", "STOPPED"}


def state_of(job):
    """The job's state from the controller; once that has forgotten it, from accounting, if any."""
    known = subprocess.run(["scontrol", "-o", "show", "job", job], capture_output=True, text=True)
    if known.returncode == 0:
        return re.search(r"JobState=(\w+)", known.stdout)[1]
    past = subprocess.run(["sacct", "-nXPj", job, "-o", "State"], capture_output=True, text=True)
    if past.returncode == 0 and past.stdout.strip():
        return past.stdout.split()[0]
    asked = "Invalid job id" in known.stderr
    return "FORGOTTEN" if asked else "PENDING"  # a controller that does not answer is asked again


def main():
    state = state_of(sys.argv[1])
    print("running" if state in WAITING else "success" if state == "COMPLETED" else "failed")


if __name__ == "__main__":
    main()
