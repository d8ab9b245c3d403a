#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The messages that the book's troubleshooting.md quotes are those of the sources, word by word.

A quotation is a line `> `message`` with … for what differs from time to time; in the sources that
is a format's {...}, or a place where another text is appended.

usage: messages_test.py    with STYLET_SOURCE in the environment
"""
import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ["STYLET_SOURCE"])
PAGE = SOURCE / "toolchain/book/troubleshooting.md"
LEAST_SYMPTOMS = 25
LITERALS = re.compile(r'(?:"(?:\\.|[^"\\\n])*"\s*)+')


def plain(literals):
    """The text of literals that follow each other, with … for what is filled in."""
    text = "".join(re.findall(r'"((?:\\.|[^"\\\n])*)"', literals))
    text = text.replace('\\"', '"').replace("\\n", "")
    return re.sub(r"\{[^{}]*\}", "…", text)


def messages():
    for folder in ("hal", "offline", "toolchain/toml"):
        for path in sorted((SOURCE / folder).rglob("*")):
            if path.suffix in {".cpp", ".h"} and "node_modules" not in path.parts:
                for match in LITERALS.finditer(path.read_text()):
                    yield plain(match[0])


def quotations(text):
    return re.findall(r"^> `(.+)`$", text, re.M)


def said(quotation, all_messages):
    """Whether some message has the quotation's words in their order, with something only at a …"""
    words = ".*".join(map(re.escape, quotation.strip("…").split("…")))
    return any(re.search(words, message) for message in all_messages)


class Messages(unittest.TestCase):
    def test_quoted_as_they_are(self):
        all_messages = list(messages())
        quoted = quotations(PAGE.read_text())
        self.assertGreater(len(quoted), LEAST_SYMPTOMS)
        self.assertEqual([each for each in quoted if not said(each, all_messages)], [])

    def test_a_message_with_other_words_is_refused(self):
        all_messages = list(messages())
        for quotation in quotations(PAGE.read_text()):
            words = quotation.split(" ")
            longest = max(range(len(words)), key=lambda i: len(words[i]))
            words[longest] = words[longest][::-1] + "x"
            self.assertFalse(said(" ".join(words), all_messages), quotation)

    def test_every_symptom_has_a_remedy_or_a_message(self):
        symptoms = re.split(r"^### ", PAGE.read_text(), flags=re.M)[1:]
        self.assertGreaterEqual(len(symptoms), LEAST_SYMPTOMS)
        for symptom in symptoms:
            self.assertRegex(symptom, r"(?m)\*\*(Do|Cause)\.\*\*|^> `", symptom.splitlines()[0])


if __name__ == "__main__":
    unittest.main()
