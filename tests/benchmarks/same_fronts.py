#!/usr/bin/env python3
"""Whether two studies of one scene agree: same_fronts.py A/study.json B/study.json.

What one study is sure of for a variant (on a front, or dominated) the other may leave open but must
not contradict. Also, the ratio of each variant's time to that of the first must agree between the
two runs, each ratio known to its 95 % interval and the run's spread (A/A): this finds a program
that is slow throughout one run. Times are those of the clock that decided (--clock). Prints the
differences; exit status 0 if nothing is contradicted, 1 if something is, 2 if the studies are not
of the same scene."""

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
        """The ratio of two variants' times, and its interval widened by the spread."""
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

    def standing(self, name, model, metric):
        """'on', 'open', or the variant that dominates it; None without errors against `model`."""
        for error in self.variants[name]["errors"]:
            if error["against"] == model:
                by = error["fronts"][metric]
                return "on" if by is True else "open" if metric in error["open"] else by
        return None


def same(a, b, one, other):
    """Whether two runs agree on the ratio of two variants' times, and a text that shows both."""
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
    both = open_in_one = open_in_both = denied = 0
    for front in a.json["fronts"]:
        for name in a.variants:
            first, second = (s.standing(name, front["model"], front["metric"]) for s in (a, b))
            if first is None:
                continue
            if "open" in (first, second):
                open_in_both += first == second
                open_in_one += first != second
            elif (first == "on") == (second == "on"):
                both += 1
            else:
                denied += 1
                by = second if first == "on" else first
                words = same(a, b, name, by)[1]
                print(f"{front['model']} {front['metric']}: {name} on the front in {'A' if first == 'on' else 'B'}, "
                      f"dominated by {by} in the other; ratio of their times: {words}")
    moved = 0
    first = next(iter(a.variants))
    for name in a.variants:
        fine, words = same(a, b, name, first)
        if not fine:
            moved += 1
            print(f"{name}: time to that of {first}: {words}: NOT within noise")
    places = both + open_in_one + open_in_both + denied
    print(f"{places} places on {len(a.json['fronts'])} fronts: {both} told alike, {open_in_one} told by one run alone, "
          f"{open_in_both} by none, {denied} denied; {moved} of {len(a.variants)} variants moved beyond noise")
    return 1 if denied else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
