"""An object told from two pictures: trained on a few rendered objects, shown one, and where to look next."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import matplotlib.image
import matplotlib.pyplot as plt
import numpy as np
import vantage
from common import folder, save

out = folder(__doc__)
built = Path(__file__).resolve().parents[1] / "build/release/vantage"
program = os.environ.get("VANTAGE_BINARY") or shutil.which("vantage") or built
if not os.access(program, os.X_OK):
    raise SystemExit(f"{program}: not there. The program `vantage` renders the objects: build it by ./run, install the "
                     "Debian package, or name it in VANTAGE_BINARY.")


def picture(stem):
    """(rgb, depth in m, mask) of a view of a dataset, and where its image's centre lies in the crop."""
    rgb = (matplotlib.image.imread(f"{stem}_crop.png")[..., :3] * 255).round().astype(np.uint8)
    depth = (matplotlib.image.imread(f"{stem}_depthcrop.png") * 65535).round() / 1000
    mask = matplotlib.image.imread(f"{stem}_maskcrop.png") > 0
    left, top = map(int, Path(f"{stem}_loc.txt").read_text().split(","))
    return rgb, depth, mask, (320 - left, 240 - top)


with tempfile.TemporaryDirectory() as work:
    objects = Path(work) / "objects"
    subprocess.run([program, "dataset", "render", str(objects), "-q", "--set", "objects=6", "--set", "step_deg=24",
                    "--set", "supersampling=1"], check=True, stdout=subprocess.DEVNULL)
    model = Path(work) / "small.model"
    vantage.train(objects, model, features=["soft_colour", "standing_box"], transition_prior_moves=0, threads=2)

    shown = sorted(path for path in objects.glob("*/*") if path.is_dir())[5]
    recogniser = vantage.Recogniser(model)
    figure, axes = plt.subplots(2, 3, figsize=(11, 6), gridspec_kw={"width_ratios": [1, 1.4, 2]})
    turn = 0.0
    for row, frame in zip(axes, (1, 6)):  # of the recording at 45 deg, which was not trained on
        rgb, depth, mask, centre = picture(shown / f"{shown.name}_2_{frame}")
        recogniser.update(rgb, depth, mask, turned_rad=turn, elevation_rad=np.pi / 4, centre_px=centre)
        following = recogniser.next_view()
        row[0].imshow(rgb)
        row[0].set_title(f"view {recogniser.views}")
        row[0].axis("off")
        row[1].barh(recogniser.objects + ["unknown"], [*recogniser.p_objects, recogniser.p_unknown])
        row[1].set(xlim=(0, 1), xlabel="probability", title=recogniser.estimate["object"])
        row[2].bar(np.degrees(following["turns_rad"]), following["gain_bits"], width=20)
        row[2].set(xlabel="turn about the object, deg", ylabel="expected information, bits",
                   title=f"look next from {np.degrees(following['turn_rad']):.0f} deg on")
        turn = -np.deg2rad(5 * 24)  # the object turned; the camera, seen from it, the other way
    print(f"shown: {shown.name}; told: {recogniser.estimate}")
    figure.tight_layout()
    save(figure, out / "recognise.png")
