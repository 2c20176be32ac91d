#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""The JSON Schema of parameter files, against jsonschema, which implements the standard: what the program reads is valid (its own
listing, and each ready case as JSON), what it refuses is not."""

import json
import unittest

import jsonschema

from support import CASES, ProgramTest


def as_json(text):
    """The content of a .prm file as the program's JSON: an object for each section."""
    root = {}
    sections = [root]
    for line in text.splitlines():
        words = line.split("#")[0].split(maxsplit=1)
        if not words:
            continue
        if words[0] == "subsection":
            sections.append(sections[-1].setdefault(words[1].strip(), {}))
        elif words[0] == "end":
            sections.pop()
        elif words[0] == "set":
            name, value = words[1].split("=", 1)
            sections[-1][name.strip()] = value.strip()
    return root


class Schema(ProgramTest):

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.validator = None

    def is_valid(self, parameters):
        if self.validator is None:
            schema = json.loads(self.run_program("--print-parameters", "schema").stdout)
            jsonschema.Draft202012Validator.check_schema(schema)
            type(self).validator = jsonschema.Draft202012Validator(schema)
        return [error.message for error in self.validator.iter_errors(parameters)]

    def test_listing(self):
        self.assertEqual(self.is_valid(json.loads(self.run_program("--print-parameters", "json").stdout)), [])

    def test_ready_cases(self):
        for case in CASES:
            text = case.read_text(encoding="utf-8")
            if "\\\n" not in text and "include" not in text:
                with self.subTest(case=case.stem):
                    self.assertEqual(self.is_valid(as_json(text)), [])

    def test_same_as_the_program(self):
        # The schema and the program accept and refuse the same files.
        for parameters, accepted in (
                ({"Discretization": {"Degree": 2}}, True), ({"Discretization": {"Degree": "2"}}, True),
                ({"Discretization": {"Degree": {"value": "2", "default_value": "3"}}}, True),
                ({"Discretization": {"Degree": 4}}, False), ({"Discretization": {"Degree": 1.5}}, False),
                ({"Discretization": {"Degree": "two"}}, False), ({"Discretization": {"Degree": None}}, False),
                ({"Discretisation": {"Degree": 2}}, False), ({"Discretization": {"degree": 2}}, False),
                ({"Material": {"Young's modulus": 1e6}}, True), ({"Material": {"Type": "linear"}}, True),
                ({"Material": {"Type": "Linear"}}, False), ({"Material": {"Type": True}}, False),
                ({"Output": {"Overwrite": True}}, True), ({"Output": {"Overwrite": "true"}}, True),
                ({"Output": {"Overwrite": "maybe"}}, False), ({"Output": {"Overwrite": 1}}, False),
                ({"Mesh": {"box": {"Cells": "2, 1, 1"}}}, True), ({"Mesh": {"box": {"Cells": [2, 1, 1]}}}, False),
                ({"Linear solver": {"Tolerance": "1e-9"}}, True), ({"Linear solver": {"Tolerance": -1}}, False),
                ({"$schema": "corotet.json", "Discretization": {"Degree": 2}}, True), ({"Mesh": 1}, False)):
            with self.subTest(parameters=parameters):
                (self.folder / "case.json").write_text(json.dumps(parameters), encoding="utf-8")
                run = self.run_program("case.json", "--validate", "--set", "Boundary conditions/Fixed = x-min", status=None)
                self.assertEqual((run.returncode == 0, not self.is_valid(parameters)), (accepted, accepted), run.stderr)


if __name__ == "__main__":
    unittest.main()
