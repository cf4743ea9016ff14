#!/usr/bin/env python3
"""Takes the view that promises most per second of driving and scanning.

A planner for `choice: {name: external, command: [python3, examples/arena/gain_rate.py]}`; the standard library is enough.
While the budget lasts, a view that would end after it counts for nothing; a forecast that is unsure counts a little more, for
what can be learnt there.
"""

import json
import math
import sys

CURIOSITY = 0.1  #: weight of the upper end of a forecast's interval


def say(message):
    print(json.dumps(message), flush=True)


def promise(view):
    """Cells that a view is expected to show."""
    if "interval" not in view:
        return view["gain"]
    return (1 - CURIOSITY) * view["gain"] + CURIOSITY * view["interval"][1]


def rate(view, request):
    """Of a view, cells a second; negative where it cannot be reached."""
    if view["travel_s"] is None:
        return -1.0
    needed_s = view["travel_s"] + request["scan_s"]
    left_s = request["time_left_s"]
    if left_s is not None and needed_s > left_s:
        return -0.5
    return promise(view) / max(needed_s, 1e-3)


def way_m(view):
    return math.inf if view["path_length_m"] is None else view["path_length_m"]


def decide(request):
    views = request["candidates"]
    views = [view for view in views if not view["exhausted"]] or views
    return max(views, key=lambda view: (rate(view, request), -way_m(view), -view["view"]))


def main():
    hello = json.loads(sys.stdin.readline())
    if hello["version"] != 1:
        sys.exit(f"version {hello['version']} of the protocol is not known")
    say({"protocol": "vantage-planner", "version": 1, "name": "gain rate"})
    for line in sys.stdin:
        request = json.loads(line)
        if request["type"] == "end":
            break
        say({"view": decide(request)["view"]})


if __name__ == "__main__":
    main()
