"""The choice `greedy` as a program: the largest gain; of equal ones the shorter way, then the lower number."""

import json
import math
import sys

sys.stdin.readline()
print(json.dumps({"protocol": "vantage-planner", "version": 1, "name": "greedy"}), flush=True)
for line in sys.stdin:
    request = json.loads(line)
    if request["type"] == "end":
        break
    views = [view for view in request["candidates"] if not view["exhausted"]] or request["candidates"]
    way_m = lambda view: math.inf if view["path_length_m"] is None else view["path_length_m"]
    best = min(views, key=lambda view: (-view["gain"], way_m(view), view["view"]))
    print(json.dumps({"view": best["view"]}), flush=True)
