"""An agent learns which view to take: a linear bandit over what is told of each candidate, against a random one.

It learns on some seeds and is tried on others, which it was not trained on.
"""

import matplotlib.pyplot as plt
import numpy as np
import vantage
from common import folder, save

out = folder(__doc__)
TRAINING, TRIED = range(1, 9), range(101, 109)
COLUMN = {name: i for i, name in enumerate(vantage.env.COLUMNS)}


def features(observation):
    """A row a candidate: 1, gain and its square, travel time, and how near the nearest view taken is."""
    table = observation["candidates"]
    gain = table[:, COLUMN["gain"]]
    here = observation["state"][:2]
    off = np.linalg.norm(table[:, [COLUMN["x_m"], COLUMN["y_m"]]] - here, axis=1)
    return np.column_stack([np.ones(len(table)), gain, gain**2, table[:, COLUMN["travel_s"]] / 10, np.exp(-off)])


class LinearBandit:
    """Upper confidence bounds of a reward that is linear in the features. [Li et al. 2010, LinUCB]"""

    def __init__(self, n, alpha=0.05):
        self.A, self.b, self.alpha = np.eye(n), np.zeros(n), alpha

    def choose(self, observation, info, explore):
        x = features(observation)
        inverse = np.linalg.inv(self.A)
        value = x @ (inverse @ self.b)
        if explore:
            value += self.alpha * np.sqrt(np.einsum("ij,jk,ik->i", x, inverse, x))
        return int(np.argmax(np.where(info["action_mask"], value, -np.inf)))

    def learn(self, x, reward):
        self.A += np.outer(x, x)
        self.b += reward * x


def episode(env, seed, choose, learn=None):
    """Sum of the rewards."""
    observation, info = env.reset(seed=seed)
    total, done = 0.0, False
    while not done:
        action = choose(observation, info)
        x = features(observation)[action]
        observation, reward, terminated, truncated, info = env.step(action)
        if learn:
            learn(x, reward)
        total += reward
        done = terminated or truncated
    return total


rng = np.random.default_rng(0)
agent = LinearBandit(5)
with vantage.Env("tabletop", scans=4, map={"cells": [33, 33, 17]}, laser={"scan_duration_s": 1}) as env:
    learnt = [episode(env, seed, lambda o, i: agent.choose(o, i, True), agent.learn) for seed in TRAINING]
    ours = [episode(env, seed, lambda o, i: agent.choose(o, i, False)) for seed in TRIED]
    at_random = [episode(env, seed, lambda o, i: rng.choice(np.flatnonzero(i["action_mask"]))) for seed in TRIED]
print(f"share of the map newly seen in 3 scans: bandit {np.mean(ours):.3f}, random {np.mean(at_random):.3f}; "
      f"better on {sum(a > b for a, b in zip(ours, at_random))} of {len(ours)} seeds")

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
left.plot(list(TRAINING), learnt, "o-")
left.set(xlabel="training episode", ylabel="newly seen share of the map", title="while it learns")
left.set_ylim(0, 1.1 * max(learnt))
right.bar(np.arange(len(ours)) - 0.2, ours, 0.4, label="bandit")
right.bar(np.arange(len(ours)) + 0.2, at_random, 0.4, label="random")
right.set_xticks(np.arange(len(ours)), [str(seed) for seed in TRIED])
right.set(xlabel="seed, not trained on", title="tried afterwards")
right.set_ylim(0, 1.2 * max(ours + at_random))
right.legend(loc="upper center", ncols=2)
save(figure, out / "learn.png")
if np.mean(ours) <= np.mean(at_random):
    raise SystemExit("the bandit did not beat random choices")
