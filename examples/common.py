"""What the examples share: where pictures go."""

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def folder(text):
    """The folder of --out, made."""
    parser = argparse.ArgumentParser(description=text)
    parser.add_argument("--out", type=Path, default=Path("out/examples"), help="folder for pictures")
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    return out


def save(figure, path):
    figure.savefig(path, dpi=110, bbox_inches="tight")
    plt.close(figure)
    print(path)
