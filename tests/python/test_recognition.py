"""Recognition from Python: trained on a small rendered dataset, updated by arrays."""

import os
import signal
import subprocess
import threading
import unittest

import numpy as np
import vantage
from support import BINARY, InFolder


def read_png(path):
    """By matplotlib, which the examples need anyway: uint8, or uint16 as float of its range."""
    import matplotlib.image
    return matplotlib.image.imread(path)


def view_of(folder, stem):
    """(rgb, depth in m, mask) of a view of a dataset."""
    rgb = (read_png(folder / f"{stem}_crop.png")[..., :3] * 255).round().astype(np.uint8)
    depth = read_png(folder / f"{stem}_depthcrop.png") * 65535 / 1000
    mask = read_png(folder / f"{stem}_maskcrop.png") > 0
    return rgb, depth.round(3), mask


class Recognition(InFolder):
    @classmethod
    def setUpClass(cls):
        import pathlib
        import tempfile
        cls.holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.holder.cleanup)
        cls.root = pathlib.Path(cls.holder.name)
        cls.dataset = cls.root / "objects"
        subprocess.run([BINARY, "dataset", "render", str(cls.dataset), "-q", "--set", "objects=4",
                        "--set", "step_deg=24", "--set", "supersampling=1"], check=True, stdout=subprocess.DEVNULL)
        cls.model = cls.root / "new" / "small.model"
        cls.told = []
        vantage.train(cls.dataset, cls.model, features=["soft_colour", "standing_box"], transition_prior_moves=0,
                      progress=lambda *part: cls.told.append(part))

    def views(self):
        """A folder of an object, its name and the stems of video 2."""
        folder = sorted(path for path in self.dataset.glob("*/*") if path.is_dir())[0]
        name = folder.name
        return folder, name, [f"{name}_2_{frame}" for frame in range(1, 10)]

    def test_tells_the_object_from_its_views(self):
        folder, name, stems = self.views()
        recogniser = vantage.Recogniser(self.model)
        self.assertIn(name, recogniser.objects)
        self.assertAlmostEqual(recogniser.posterior.sum() + recogniser.p_unknown, 1.0)
        before = recogniser.entropy_bits
        for i, stem in enumerate(stems[:3]):
            told = recogniser.update(*view_of(folder, stem), turned_rad=0 if i == 0 else -np.deg2rad(24),
                                     elevation_rad=np.pi / 4)
            self.assertTrue(told["features"])
        self.assertEqual(recogniser.views, 3)
        self.assertEqual(recogniser.posterior.shape, (len(recogniser.objects), recogniser.bins))
        self.assertLess(recogniser.entropy_bits, before)
        self.assertEqual(recogniser.estimate["object"], name)
        np.testing.assert_allclose(recogniser.posterior.sum(axis=1), recogniser.p_objects)
        self.assertAlmostEqual(recogniser.p_categories.sum(), 1.0, delta=recogniser.p_unknown + 1e-9)
        recogniser.reset()
        self.assertAlmostEqual(recogniser.entropy_bits, before)

    def test_is_what_the_command_line_says(self):
        import json
        folder, name, stems = self.views()
        said = json.loads(subprocess.run(
            [BINARY, "recognise", "--model", str(self.model), str(folder / f"{stems[0]}_crop.png"),
             str(folder / f"{stems[0]}_depthcrop.png"), "--json", "--top", "1"],
            check=True, capture_output=True, text=True).stdout)
        left, top = map(int, (folder / f"{stems[0]}_loc.txt").read_text().split(","))
        recogniser = vantage.Recogniser(self.model)
        recogniser.update(*view_of(folder, stems[0]), elevation_rad=np.pi / 4,
                          centre_px=(320 - left, 240 - top))
        best = int(np.argmax(recogniser.p_objects))
        self.assertEqual(said["objects"][0]["object"], recogniser.objects[best])
        self.assertAlmostEqual(said["objects"][0]["probability"], recogniser.p_objects[best], places=6)

    def test_says_where_to_look_next_and_at_what(self):
        folder, _, stems = self.views()
        recogniser = vantage.Recogniser(self.model)
        first = recogniser.next_feature()
        self.assertIn(first["feature"], recogniser.features)
        self.assertEqual(set(first["gain_bits"]), set(recogniser.features))
        self.assertEqual(recogniser.next_feature(recogniser.features)["feature"], None)
        recogniser.update(*view_of(folder, stems[0]))
        following = recogniser.next_view()
        self.assertEqual(len(following["gain_bits"]), recogniser.bins - 1)
        self.assertIn(following["turn_rad"], following["turns_rad"])
        self.assertEqual(recogniser.next_view([0.5])["turn_rad"], 0.5)

    def test_progress_is_told(self):
        self.assertIn("extracting features", {part for part, _, _ in self.told})

    def test_training_is_stopped_by_ctrl_c(self):
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(100):
                vantage.train(self.dataset, self.folder / "never.model", features=["sift", "vfh"], threads=2)
        timer.join()

    def test_what_raises_in_progress_ends_training(self):
        def stop(*_):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            vantage.train(self.dataset, self.folder / "never.model", features=["soft_colour"], progress=stop)
        self.assertFalse((self.folder / "never.model").exists())

    def test_what_cannot_be_is_told(self):
        rgb, depth, mask = view_of(self.views()[0], self.views()[2][0])
        recogniser = vantage.Recogniser(self.model)
        for message, call in {
            "shapes": lambda: recogniser.update(rgb, depth[1:], mask),
            "mask: shape": lambda: recogniser.update(rgb, depth, mask[1:]),
            "mask: empty": lambda: recogniser.update(rgb, depth, np.zeros_like(mask)),
            "focal_px": lambda: recogniser.update(rgb, depth, mask, focal_px=0),
            "turned_rad": lambda: recogniser.update(rgb, depth, mask, turned_rad=np.nan),
            "turns_rad": lambda: recogniser.next_view([]),
            "unknown key": lambda: vantage.Recogniser(self.model, recognition={"x": 1}),
            "recognition.views.weight_per_s: 1":
                lambda: vantage.Recogniser(self.model, recognition={"views": {"weight_per_s": 1}}),
        }.items():
            with self.assertRaisesRegex(vantage.ConfigError, message):
                call()
        self.assertEqual(recogniser.views, 0)
        with self.assertRaises(vantage.InputError):
            vantage.Recogniser(self.root / "none.model")
        with self.assertRaises(vantage.InputError):
            vantage.train(self.folder / "nothing", self.folder / "x.model")


if __name__ == "__main__":
    unittest.main()
