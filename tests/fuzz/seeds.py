"""What fuzzing starts from: files of the tree, and of a short run, recording and model that are made for it."""

import os
import re
import shutil
import struct
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
VANTAGE = Path(os.environ.get("VANTAGE_BINARY", ROOT / "build" / "release" / "vantage"))
LARGEST = 65536  # bytes; of longer files the beginning
HELLO = b'{"protocol": "vantage-planner", "version": 1, "name": "mine"}\n'
SMALL_RUN = ["scans=2", "threads=1", "laser.scan_duration_s=1", "map.cells=[9, 9, 5]"]
SMALL_RECORDING = ["objects=2", "step_deg=90", "videos=[1]", "supersampling=1"]
SMALL_TRAINING = ["videos=[1]", "features=[soft_colour, standing_box, sift]", "feature_views=8"]


def vantage(*arguments, settings=()):
    sets = [part for setting in settings for part in ("--set", setting)]
    subprocess.run([VANTAGE, *arguments, *sets, "-q"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)


def real_runs(folder):
    """A run, a recording and a model, made once."""
    if (folder / "whole").exists():
        return
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    vantage("run", ROOT / "assets/episodes/tabletop.yaml", "--out", folder / "run", settings=SMALL_RUN)
    vantage("dataset", "render", folder / "recording", settings=SMALL_RECORDING)
    vantage("train", folder / "recording", "--out", folder / "objects.model", settings=SMALL_TRAINING)
    (folder / "whole").touch()


def parts(*contents):
    """As parts_of() takes them apart."""
    return b"".join(struct.pack("<I", len(content)) + content for content in contents[:-1]) + contents[-1]


def field(number, content):
    """A field of Protocol Buffers: a number, or bytes after their length."""
    def varint(value):
        return bytes([value & 127 | 128]) + varint(value >> 7) if value > 127 else bytes([value])
    if isinstance(content, int):
        return varint(number << 3) + varint(content)
    return varint(number << 3 | 2) + varint(len(content)) + content


def network(layer):
    """An ONNX network of one layer, of three channels."""
    def value(name, sizes):
        shape = b"".join(field(1, field(1, size)) for size in sizes)
        return field(1, name) + field(2, field(1, field(1, 1) + field(2, shape)))
    node = field(1, b"x") + field(2, b"y") + field(4, layer)
    graph = field(1, node) + field(2, b"g") + field(11, value(b"x", (1, 3, 224, 224))) + \
        field(12, value(b"y", (1, 3, 1, 1)))
    return field(1, 7) + field(7, graph) + field(8, field(1, b"") + field(2, 11))


def array(kind, shape, values):
    """As NumPy writes it."""
    head = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}".ljust(117).encode() + b"\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head + values


def ply():
    properties = "".join(f"property float {axis}\n" for axis in "xyz")
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex 2\n{properties}" \
        "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
    return head.encode() + 2 * (struct.pack("<3f", 1, 2, 3) + b"\x01\x02\x03")


def drawn_scene():
    """A triangle, as a flight records its room."""
    corners = b"".join(struct.pack("<3f4B", x, y, 0, 255, 0, 0, 0) for x, y in ((0, 0), (1, 0), (0, 1)))
    return b"VTGSCN01" + struct.pack("<6f7Q", 0, 0, 0, 1, 1, 1, 3, 1, 0, 0, 0, 0, 0) + corners + struct.pack("<3I", 0, 1, 2)


def plans():
    """A tour of three stops and one of one, as a choice that plans ahead leaves them."""
    head = b"scan,time_s,change,saved_s,stop,candidate,x_m,y_m,yaw_rad,arrival_s,departure_s,gain,beyond,gain_unit\n"
    return head + b"2,14.5,first,,1,7,1,2,0.5,3,13,900,0,cells\n2,14.5,first,,2,,4,5,0.25,20,31,80,12.5,cells\n" \
        b"2,14.5,first,,3,1,-4,5e-1,-0.25,40,50.5,8,0,cells\n3,60,cheaper,14.25,1,9,1,2,0,3,13,900,0,bits\n"


def story_of_plan():
    """A decision without candidates, and its tour."""
    tour = struct.pack("<QIIQd", 40, 4, 1, 7, 14.25) + struct.pack("<8d", 3, 1, 2, 0.5, 10, 20, 900, 0)
    return b"VANTAGE STORY 1\n" + struct.pack("<QIIQ", 40, 1, 0, 0) + tour


def view_of(recording):
    crop = sorted(recording.rglob("*_crop.png"))[0]
    beside = lambda ending: Path(str(crop).replace("crop.png", ending)).read_bytes()
    return parts(beside("pose.txt"), beside("loc.txt"), beside("maskcrop.png"), beside("depthcrop.png"), beside("crop.png"))


def of_targets(made):
    """{target: files, or their contents}"""
    run, tree = made / "run", lambda *patterns: [file for p in patterns for file in sorted(ROOT.glob(p))]
    pictures = [file for file in sorted(made.glob("recording/**/*.png"))[:9] if "sheet" not in file.name]
    json = [(run / name).read_bytes() for name in ("manifest.json", "metrics.json")]
    states = (run / "states.bin").read_bytes()
    return {
        "yaml": tree("assets/episodes/*.yaml", "assets/sensors/*.yaml", "models/robots/*/robot.yaml"),
        "episode": tree("assets/episodes/*.yaml") + [run / "config.yaml"],
        "study": tree("assets/studies/*.yaml", "assets/studies/*/*.yaml"),
        "recipe": tree("assets/models/*.yaml"),
        "robot": tree("models/robots/*/robot.yaml"),
        "mjcf": tree("docs/tutorials/kitchen.xml", "models/robots/*/*.xml") +
                [b'<mujoco><worldbody><body name="b"><freejoint/><geom size=".1"/></body></worldbody></mujoco>'],
        "octomap_bt": [run / "map.bt"], "octomap_ot": [run / "map.ot"],
        "views_csv": tree("assets/views/*.csv"),
        "model": [made / "objects.model"],
        "onnx": [network(layer) for layer in (b"GlobalAveragePool", b"Flatten", b"Relu", b"Softmax")],
        "pictures": pictures, "dataset_view": [view_of(made / "recording")],
        "npy": [array("<f4", (1, 2), struct.pack("<2f", 1, 2)), array("<u2", (2, 1), b"\1\0\2\0"),
                array("<f8", (1, 1, 1), struct.pack("<d", 1))],
        "ply": [ply(), run / "cloud.ply"],
        "picture_notes": [b"cut: mask\nbins: 2\nviews: [front, back]\nrecordings: [a, b]\ndegrees: false\n"],
        "camera_files": [b"fx: 570\nfy: 570\ncx: 320\ncy: 240\n", b'{"fx": 1, "fy": 1, "cx": 0, "cy": 0}', b"90 30\n",
                         b"570 0 320\n0 570 240\n0 0 1\n", b"1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 1\n"],
        "voxels": [run / "voxels.bin"], "scene_bin": [drawn_scene()], "story": [run / "story.bin", story_of_plan()],
        "states": [states[:2048], states[:9000]], "actions": [run / "actions.csv", b"tick,robot/x,robot/y,robot/yaw\n0,1,2,3\n"],
        "tables": [run / "steps.csv", run / "trajectory.tum"], "plans_csv": [plans()],
        "manifest": json[:1], "metrics": json[1:], "report_page": [parts(json[0], b"{}", b"{}", json[1])],
        "planner_answer": [parts(HELLO, b'{"view": 1}\n'), parts(HELLO + b'{"pose": [0.1,', b' 0.2, 0.3]}\n{"view": 0, "why": "x"}\n'),
                           parts(b"", b'{"protocol": "vantage-planner", "version": 2}\n')],
        "claim": [b'{"host": "a", "machine": "m", "pid": 7, "started": "3", "released": true}',
                  b'{"host": "a", "pid": 7, "slurm": {"cluster": "c", "job": "1", "task": "2", "restart": 0}}'],
        "branches": [b'{"decisions": [{"scan": 1, "branches": []}, {"scan": 2, "regret": null}]}'],
        "worker_message": [parts(b"code: 0\n", b""), b"\x04\0\0\0\0\0\0\0abcd"],
    }


def contents_of(seed):
    return (seed if isinstance(seed, bytes) else seed.read_bytes())[:LARGEST] if seed else b""


def write_words(seed_contents, file):
    """A dictionary for libFuzzer: the words and numbers of texts."""
    text = b"\n".join(seed_contents)
    if b"\0" in text:
        return
    words = sorted(set(re.findall(rb"[A-Za-z_][A-Za-z_0-9/-]{2,30}|-?\d+(?:\.\d+)?", text)))[:600]
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(b"".join(b'"' + word + b'"\n' for word in words))


def make(targets, out):
    """Writes the seeds of the targets below `out`."""
    real_runs(out / "made")
    known = of_targets(out / "made")
    for target in targets:
        folder = out / "seeds" / target
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        contents = [contents_of(seed) for seed in known[target]]
        for i, content in enumerate(contents):
            (folder / str(i)).write_bytes(content)
        write_words(contents, out / "words" / f"{target}.txt")
