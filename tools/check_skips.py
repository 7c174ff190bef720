#!/usr/bin/env python3
"""Fails when a test was skipped or is disabled without standing in the list of skips.

Usage: check_skips.py JUNIT.xml SKIPS.txt. The list has one test a line, its name as CTest prints it
(`*` stands for anything), then the reason. Says nothing when all is well.
"""
import fnmatch
import sys
import xml.etree.ElementTree as xml


def read_skips(path):
    """{pattern: reason}; a line without a reason is an error."""
    skips = {}
    with open(path, encoding="utf-8") as lines:
        for number, line in enumerate(lines, 1):
            line = line.strip()
            if not line or line.startswith("#"):
                continue
            pattern, _, reason = line.partition(" ")
            if not reason.strip():
                sys.exit(f"{path}:{number}: {pattern}: a skip needs its reason, on the same line")
            skips[pattern] = reason.strip()
    return skips


def skipped_tests(path):
    return [case.get("name") for case in xml.parse(path).iter("testcase")
            if case.get("status") in ("notrun", "disabled") or case.find("skipped") is not None]


def main(junit, skips_file):
    patterns = read_skips(skips_file)
    unexpected = [name for name in skipped_tests(junit)
                  if not any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)]
    for name in unexpected:
        print(f"{name}: did not run, and {skips_file} gives no reason for that", file=sys.stderr)
    return 1 if unexpected else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
