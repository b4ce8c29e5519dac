#!/usr/bin/env python3
"""Whether two studies of one scene say the same: same_fronts.py A/study.json B/study.json.

Their fronts must have the same members, but for those whose step is as small as noise: where a member
of one front is dominated in the other, the ratio of its time to its dominator's must be the same in
both runs, each known to its 95 % interval and the run's spread (A/A). So must be the time of every
variant beside that of the first: a program that is slow for the whole of one run is found here.
Times are those of the clock that decided (--clock). Prints what differs; exit status 0 if it is within noise, 1 if not, 2 if the studies are not of one
scene."""

import json
import random
import sys


def lower_quartile(values):
    ordered = sorted(values)
    place = 0.25 * (len(ordered) - 1)
    below = int(place)
    above = min(below + 1, len(ordered) - 1)
    return ordered[below] + (place - below) * (ordered[above] - ordered[below])


class Study:
    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.json = json.load(file)
        self.variants = {v["name"]: v for v in self.json["variants"]}
        self.spread = self.json["spread"]
        if self.json["noFront"]:
            sys.exit(f"{path}: {self.json['noFront']}")
        self.rounds = "cpuRounds" if self.json["clock"] == "cpu" else "rounds"

    def ratio(self, one, other):
        """Of the times of two variants: value, and its interval widened by the spread."""
        a = self.variants[one]["times"][self.rounds]
        b = self.variants[other]["times"][self.rounds]
        engine = random.Random(1)
        drawn = []
        for _ in range(300):
            rounds = [engine.randrange(len(a)) for _ in a]
            drawn.append(lower_quartile([a[i] for i in rounds]) / lower_quartile([b[i] for i in rounds]))
        drawn.sort()
        low, high = drawn[7], drawn[-8]
        return (lower_quartile(a) / lower_quartile(b), low / (1 + self.spread), high * (1 + self.spread))

    def dominator(self, front, name):
        for error in self.variants[name]["errors"]:
            if error["against"] == front[0]:
                return error["fronts"][front[1]]
        return None


def same(a, b, one, other):
    """Whether two runs tell the same ratio of two variants' times, and the words for it."""
    first, second = a.ratio(one, other), b.ratio(one, other)
    words = f"{first[0]:.3f} ({first[1]:.3f} to {first[2]:.3f}) and {second[0]:.3f} ({second[1]:.3f} to {second[2]:.3f})"
    return first[1] <= second[2] and second[1] <= first[2], words


def main(paths):
    if len(paths) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    a, b = map(Study, paths)
    for key in ("model", "resolution", "triangles", "look", "clock"):
        if a.json[key] != b.json[key]:
            print(f"{paths[1]}: another {key} than {paths[0]}", file=sys.stderr)
            return 2
    if list(a.variants) != list(b.variants):
        print(f"{paths[1]}: other variants than {paths[0]}", file=sys.stderr)
        return 2
    print(f"{a.json['model']}: {len(a.variants)} variants, {a.json['resolution']} pixels, "
          f"spread {100 * a.spread:.1f} and {100 * b.spread:.1f} %")
    bad = differing = members = 0
    fronts = [{(f["model"], f["metric"]): set(f["variants"]) for f in s.json["fronts"]} for s in (a, b)]
    for front in fronts[0]:
        members += len(fronts[0][front] | fronts[1][front])
        for run, name in [(b, n) for n in fronts[0][front] - fronts[1][front]] + \
                         [(a, n) for n in fronts[1][front] - fronts[0][front]]:
            differing += 1
            by = run.dominator(front, name)
            fine, words = same(a, b, name, by)
            bad += not fine
            print(f"{' '.join(front)}: {name} only in {'A' if run is b else 'B'}; its time to that of {by}: {words}: "
                  + ("within noise" if fine else "NOT within noise"))
    moved = 0
    first = next(iter(a.variants))
    for name in a.variants:
        fine, words = same(a, b, name, first)
        if not fine:
            moved += 1
            print(f"{name}: time to that of {first}: {words}: NOT within noise")
    print(f"{members} members of {len(fronts[0])} fronts, {differing} of one run alone, {bad} of them beyond noise; "
          f"{moved} of {len(a.variants)} variants moved beyond noise")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
