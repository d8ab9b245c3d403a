#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""No tick of random sessions takes more instructions than its bound (tests/rt/tick_work.h), or as
many as the worst case (tests/rt/costs.txt).

usage: costs.py REPOSITORY STYLET_SESSION_COSTS SEED COUNT
"""
import pathlib
import shutil
import sys
import tempfile

SKIPPED = 77


def main(repository, program, seed, sessions):
    if shutil.which("valgrind") is None:
        print("skipped: no valgrind here; toolchain/setup.sh installs it")
        return SKIPPED
    sys.path.insert(0, f"{repository}/tests/rt")
    sys.dont_write_bytecode = True
    import costs
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "callgrind.out"
        command = [program, folder, seed, sessions]
        costs.call(command)
        costs.call(["valgrind", "--tool=callgrind", "--collect-atstart=no", "--combine-dumps=yes",
                    f"--callgrind-out-file={out}", *command])
        ticks = [(int(cost), int(bound), which, tick)
                 for tick, which, bound, cost in costs.DUMP.findall(out.read_text())]
    worst = costs.read_rows(pathlib.Path(repository) / "tests/rt/costs.txt")[costs.WORST][1]
    most = max(cost / bound for cost, bound, _, _ in ticks)
    dearest = max(ticks)
    print(f"{len(ticks)} ticks of {sessions} sessions: at most {most:.3f} of their bounds; "
          f"the dearest takes {dearest[0]} instructions ({dearest[2]}, tick {dearest[3]}), "
          f"the worst case {worst}")
    wrong = [f"{which}, tick {tick}: {cost} instructions, more than its bound {bound}"
             for cost, bound, which, tick in ticks if cost > bound or cost > worst]
    if len(ticks) < 5 * int(sessions):
        wrong.append("too few ticks were counted to prove anything")
    print("\n".join(wrong))
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
