#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The metrics' text as Prometheus reads it: by the parser of its client library, its naming rules,
and promtool if that is installed.

usage: metrics_test.py PROGRAM   which prints a sample between <<< and >>>
"""
import math
import re
import shutil
import subprocess
import sys
import unittest

try:
    from prometheus_client.parser import text_string_to_metric_families
except ImportError:
    text_string_to_metric_families = None

PROGRAM = sys.argv.pop(1)
NAME = re.compile(r"[a-zA-Z_:][a-zA-Z0-9_:]*$")
LABELS = r'\{(?:[a-z_]+="(?:[^"\\\n]|\\["\\n])*",?)+\}'
SAMPLE = re.compile(rf"[a-z_]+(?:{LABELS})? (?:[0-9.e+-]+|\+Inf|NaN)$")


def sample():
    out = subprocess.run([PROGRAM, "--gtest_filter=Metrics.Sample"], check=True,
                         capture_output=True, text=True).stdout
    return out[out.index("<<<\n") + 4:out.index(">>>\n")]


class Format(unittest.TestCase):
    def setUp(self):
        self.text = sample()

    def test_every_line_is_of_the_grammar(self):
        self.assertTrue(self.text.endswith("\n"))
        kinds, done, current = {}, set(), None
        for line in self.text.splitlines():
            if line.startswith("# HELP "):
                current = line.split()[2]
                self.assertRegex(current, NAME)
                self.assertNotIn(current, done, "a metric's lines must be together")
                done.add(current)
            elif line.startswith("# TYPE "):
                _, _, name, kind = line.split()
                self.assertEqual(name, current)
                kinds[name] = kind
            else:
                self.assertRegex(line, SAMPLE)
                self.assertTrue(line.startswith(current), line)
        self.assertEqual(set(kinds), done)
        for name, kind in kinds.items():
            self.assertEqual(kind == "counter", name.endswith("_total"), name)

    @unittest.skipUnless(text_string_to_metric_families, "python3-prometheus-client is missing")
    def test_the_client_librarys_parser_reads_it(self):
        families = {each.name: each for each in text_string_to_metric_families(self.text)}
        info = families["stylet_info"].samples[0]
        self.assertEqual(info.labels["scene"], 'a"b\\c?d} 1?# TYPE ? ?.toml')
        self.assertEqual(families["stylet_period_seconds"].samples[0].value, 1e-3)
        histogram = families["stylet_tick_duration_seconds"]
        self.assertEqual(histogram.type, "histogram")
        buckets = [(float(s.labels["le"]), s.value) for s in histogram.samples
                   if s.name.endswith("_bucket")]
        self.assertEqual(buckets, sorted(buckets))
        self.assertEqual(buckets[-1][0], math.inf)
        values = {s.name: s.value for s in histogram.samples}
        self.assertEqual(buckets[-1][1], values["stylet_tick_duration_seconds_count"])
        # 0, 7, 14 ... us, written with all their digits
        expected = sum(range(0, 2000, 7)) * 1e-6
        self.assertAlmostEqual(values["stylet_tick_duration_seconds_sum"], expected, places=12)
        self.assertEqual(dict(buckets)[1e-3], len(range(0, 1001, 7)))

    @unittest.skipUnless(shutil.which("promtool"), "promtool is missing")
    def test_promtool_has_no_complaint(self):
        done = subprocess.run(["promtool", "check", "metrics"], input=self.text, text=True,
                              capture_output=True, check=False)
        self.assertEqual((done.returncode, done.stdout + done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
