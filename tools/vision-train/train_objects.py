"""Trains the network that finds balls, robots and goal posts in whole images; writes it as ONNX.

Its input is the image at half of its size, its output a grid of cells of 16 pixels of the image.
Packages: scripts/setup --with train. README.md in this folder has the commands.
"""

import json
from pathlib import Path

import cv2
import numpy as np
import torch
from torch import nn

import common

ROWS, COLUMNS = 240, 320
# Pixels of the network's input for each cell, for each cell of balls, which are smaller, and for each
# unit of a robot's box.
CELL = 8
BALL_CELL = 4
BOX_UNIT = 32
# Values of each kind: log odds, then the values of its place, as in ObjectDetector.
NUM_BALL, NUM_ROBOT, NUM_POST = 4, 7, 4
# Channels of the output: a ball's values for the 2x2 parts of a cell, then the other kinds'.
BALL_CHANNELS = 4 * NUM_BALL
NUM_CHANNELS = BALL_CHANNELS + NUM_ROBOT + NUM_POST
BALL, ROBOT, POST = range(3)
KINDS = {"ball": BALL, "robot": ROBOT, "goal-post": POST}
POST_RADIUS = 0.05
# Objects that are less visible are neither required nor wrong.
LEAST_VISIBLE = {BALL: 0.35, ROBOT: 0.4, POST: 0.6}


class ObjectNetwork(nn.Module):
    """About 50 million multiplications for an image."""

    def __init__(self):
        super().__init__()
        self.fine = nn.Sequential(
            nn.Conv2d(3, 8, 4, 2, 1, bias=False),
            nn.BatchNorm2d(8),
            nn.ReLU(inplace=True),
            common.convolution(8, 16, 3, 2),
        )
        self.middle = nn.Sequential(
            common.convolution(16, 24, 3, 2),
            common.convolution(24, 24, 3),
        )
        # The convolutions are dilated, since the whole image decides what a part of it is.
        self.coarse = nn.Sequential(
            common.convolution(24, 32, 3, 2),
            common.convolution(32, 32, 3, dilation=2),
            common.convolution(32, 32, 3, dilation=4),
            common.convolution(32, 32, 3, dilation=2),
            nn.Conv2d(32, 24, 1),
            nn.Upsample(scale_factor=2),
        )
        self.join = nn.Sequential(nn.ReLU(inplace=True), common.convolution(24, 32, 3))
        self.others = nn.Conv2d(32, NUM_ROBOT + NUM_POST, 1)
        self.detail = nn.Conv2d(16, 16, 3, 1, 1, bias=False)
        self.context = nn.Sequential(nn.Conv2d(32, 16, 1), nn.Upsample(scale_factor=2))
        self.balls = nn.Sequential(nn.ReLU(inplace=True), nn.Conv2d(16, BALL_CHANNELS, 2, 2))
        # Initially every place is improbable.
        with torch.no_grad():
            self.others.bias[[0, NUM_ROBOT]] = -4.0
            self.balls[-1].bias[:4] = -4.0

    def forward(self, images):
        fine = self.fine(images)
        middle = self.middle(fine)
        join = self.join(middle + self.coarse(middle))
        balls = self.balls(self.detail(fine) + self.context(join))
        return torch.cat([balls, self.others(join)], dim=1)


def by_kind(output):
    """Maps of the values of each kind: N x values x rows x columns of its cells."""
    balls = nn.functional.pixel_shuffle(output[:, :BALL_CHANNELS], 2)
    others = output[:, BALL_CHANNELS:]
    return [balls, others[:, :NUM_ROBOT], others[:, NUM_ROBOT:]]


def rotation(q):
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def project(camera, point):
    """Pixel of a point in the heading frame and its depth, as CameraGeometry::project(); or None."""
    place = np.array(camera["position_in_heading"])
    x, y, z = rotation(camera["orientation_in_heading"]).T @ (np.array(point) - place)
    if x < 0.05:
        return None
    k1, k2, p1, p2, k3 = camera["distortion"]
    u, v = -y / x, -z / x
    r2 = u * u + v * v
    # Farther out the model of the distortion folds back into the image.
    if 1 + r2 * (3 * k1 + r2 * (5 * k2 + r2 * 7 * k3)) <= 0:
        return None
    radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
    ud = u * radial + 2 * p1 * u * v + p2 * (r2 + 2 * u * u)
    vd = v * radial + p1 * (r2 + 2 * v * v) + 2 * p2 * u * v
    return camera["cx"] + camera["fx"] * ud, camera["cy"] + camera["fy"] * vd, x


def make_object(label, kind, camera):
    """Box (left, top, right, bottom), foot or center (x, y), radius: pixels of the half image."""
    x, y, width, height = label["bbox"]
    box = np.array([x, y, x + width, y + height])
    foot = np.array([box[0] + width / 2, box[3]])
    radius = width / 2
    if kind == BALL:
        foot[1] = y + height / 2
    else:
        pixel = project(camera, [*label["position"], 0.0])
        # Without its foot in the image an object has no place on the ground.
        if pixel is None:
            return None
        foot = np.array(pixel[:2])
        radius = camera["fx"] * POST_RADIUS / pixel[2]
    # Pixel i of the half image covers pixels 2 i and 2 i + 1.
    return {
        "kind": kind,
        "box": (box - 0.5) / 2,
        "foot": (foot - 0.5) / 2,
        "radius": radius / 2,
        "visible": label["visible"],
    }


def read(folders):
    """Images at half of their size, and the objects in each."""
    images, objects = [], []
    for folder in folders:
        data = json.loads((Path(folder) / "labels.json").read_text())
        names = {category["id"]: category["name"] for category in data["categories"]}
        labels = {}
        for label in data["annotations"]:
            labels.setdefault(label["image_id"], []).append(label)
        for image in data["images"]:
            bgr = cv2.imread(str(Path(folder) / image["file_name"]))
            images.append(cv2.resize(bgr, (COLUMNS, ROWS), interpolation=cv2.INTER_AREA))
            found = []
            for label in labels.get(image["id"], []):
                kind = KINDS.get(names[label["category_id"]])
                if kind is not None:
                    found.append(make_object(label, kind, image["camera"]))
            objects.append([o for o in found if o is not None])
    return np.stack(images), objects


def moved(image, objects, random):
    """Mirrored, scaled, turned and shifted at random."""
    scale = np.exp(random.uniform(-0.25, 0.25))
    turn = random.normal(0, 0.04)
    mirror = -1.0 if random.random() < 0.5 else 1.0
    center = np.array([COLUMNS / 2 - 0.5, ROWS / 2 - 0.5])
    shift = random.uniform(-0.08, 0.08, 2) * [COLUMNS, ROWS]
    linear = scale * np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    linear = linear @ np.diag([mirror, 1.0])
    matrix = np.column_stack([linear, center + shift - linear @ center])
    image = cv2.warpAffine(image, matrix, (COLUMNS, ROWS), flags=cv2.INTER_LINEAR)
    if random.random() < 0.15:
        image = cv2.GaussianBlur(image, (0, 0), random.uniform(0.3, 1.2))
    result = []
    for o in objects:
        left, top, right, bottom = o["box"]
        corners = np.array([[left, top], [right, top], [left, bottom], [right, bottom]])
        corners = corners @ linear.T + matrix[:, 2]
        low = np.clip(corners.min(axis=0), 0, [COLUMNS - 1, ROWS - 1])
        high = np.clip(corners.max(axis=0), 0, [COLUMNS - 1, ROWS - 1])
        if min(high - low) < 1:
            continue
        # A ball's box stays its circle's.
        box = np.concatenate([low, high])
        foot = linear @ o["foot"] + matrix[:, 2]
        result.append({**o, "box": box, "foot": foot, "radius": o["radius"] * scale})
    return image, result


def cell_of(kind):
    return BALL_CELL if kind == BALL else CELL


def targets_of(objects):
    """Targets and weights of the values of each kind: values x rows x columns of its cells."""
    targets, weights = [], []
    for kind, num_values in ((BALL, NUM_BALL), (ROBOT, NUM_ROBOT), (POST, NUM_POST)):
        cell = cell_of(kind)
        shape = (num_values, ROWS // cell, COLUMNS // cell)
        target, weight = np.zeros(shape, np.float32), np.zeros(shape, np.float32)
        weight[0] = 1
        yy, xx = np.mgrid[0 : shape[1], 0 : shape[2]]
        # Middle of each cell in pixels of the half image.
        cx, cy = cell * (xx + 0.5) - 0.5, cell * (yy + 0.5) - 0.5
        for o in objects:
            if o["kind"] == kind:
                add_target(o, cell, xx, yy, cx, cy, target, weight)
        targets.append(target)
        weights.append(weight)
    return targets, weights


def add_target(o, cell, xx, yy, cx, cy, target, weight):
    kind, box, foot = o["kind"], o["box"], o["foot"]
    place = foot
    is_inside = 0 <= foot[0] < COLUMNS - 1 and 0 <= foot[1] < ROWS - 1
    if kind == ROBOT:
        place = np.array([(box[0] + box[2]) / 2, (box[1] + box[3]) / 2])
    elif kind == BALL:
        # Its center may be a little below the image.
        place = np.array([foot[0], min(foot[1], ROWS - 1)])
        is_inside = 0 <= foot[0] < COLUMNS - 1 and 0 <= foot[1] < ROWS + 0.9 * o["radius"]
    if kind != ROBOT and not is_inside:
        return
    i, j = int(place[0] // cell), int(place[1] // cell)
    size = min(box[2] - box[0], box[3] - box[1]) if kind == ROBOT else 2 * o["radius"]
    sigma = cell * np.clip(size / cell / 5, 0.5, 2.5)
    near = np.exp(-((cx - place[0]) ** 2 + (cy - place[1]) ** 2) / (2 * sigma**2))
    if o["visible"] < LEAST_VISIBLE[kind]:
        weight[0][near > 0.05] = 0
        weight[0, j, i] = 0
        return
    target[0] = np.maximum(target[0], 0.95 * near)
    target[0, j, i] = 1
    # Places are also learnt in the neighboring cells.
    cells = (np.abs(xx - i) <= 1) & (np.abs(yy - j) <= 1)
    dx, dy = foot[0] - cx, foot[1] - cy
    if kind == ROBOT:
        values = [cx - box[0], cy - box[1], box[2] - cx, box[3] - cy, dx, dy]
        values = [value / BOX_UNIT for value in values]
    else:
        values = [dx / cell, dy / cell, np.full_like(dx, np.log(max(o["radius"], 0.5) / cell))]
    for k, value in enumerate(values):
        target[1 + k][cells] = value[cells]
        weight[1 + k][cells] = 1


def loss_of(output, targets, weights):
    """Focal loss of the log odds (as CenterNet), smooth L1 of the places."""
    total = 0
    for values, target, weight in zip(by_kind(output), targets, weights):
        odds, goal = values[:, 0], target[:, 0]
        is_center = goal == 1
        p = odds.sigmoid()
        hit = -((1 - p) ** 2) * nn.functional.logsigmoid(odds)
        miss = -((1 - goal) ** 4) * p**2 * nn.functional.logsigmoid(-odds)
        judgement = (torch.where(is_center, hit, miss) * weight[:, 0]).sum()
        total = total + judgement / max(1, int(is_center.sum()))
        errors = nn.functional.smooth_l1_loss(
            values[:, 1:], target[:, 1:], beta=0.2, reduction="none"
        )
        count = weight[:, 1:].sum().clamp(min=1)
        total = total + 1.5 * (errors * weight[:, 1:]).sum() / count
    return total


def report(network, images, objects):
    """Recall of the objects among the best 8 cells of each kind, and at odds above 1."""
    network.eval()
    found = {kind: [0, 0, 0, 0, []] for kind in KINDS.values()}
    with torch.no_grad():
        for k, image in enumerate(images):
            batch = torch.from_numpy(image.transpose(2, 0, 1)[None]).float()
            maps = by_kind(network(common.normalized(batch)))
            for kind, counts in found.items():
                values, cell = maps[kind][0], cell_of(kind)
                odds = values[0]
                peaks = nn.functional.max_pool2d(odds[None, None], 3, 1, 1)[0, 0] == odds
                best = (odds * peaks + -99.0 * ~peaks).flatten().sort(descending=True)
                counts[3] += int((best.values > 0).sum())
                for o in objects[k]:
                    if o["kind"] != kind or o["visible"] < 0.6:
                        continue
                    counts[0] += 1
                    hits = []
                    for n in range(8):
                        j, i = divmod(int(best.indices[n]), COLUMNS // cell)
                        unit, at = (BOX_UNIT, 5) if kind == ROBOT else (cell, 1)
                        dx, dy = values[at : at + 2, j, i].tolist()
                        x = cell * (i + 0.5) - 0.5 + unit * dx
                        y = cell * (j + 0.5) - 0.5 + unit * dy
                        error = np.hypot(x - o["foot"][0], y - o["foot"][1])
                        limit = 0.8 * o["radius"]
                        if kind != BALL:
                            limit = max(4, 0.25 * (o["box"][3] - o["box"][1]))
                        if error < limit:
                            hits.append((float(best.values[n]), error))
                    counts[1] += bool(hits)
                    counts[2] += bool(hits) and hits[0][0] > 0
                    if hits:
                        counts[4].append(hits[0][1])
    for name, kind in KINDS.items():
        number, in_best, certain, detections, errors = found[kind]
        print(
            f"  {name}: {number}, among the best 8 {in_best / max(1, number):.3f}, "
            f"odds above 1 {certain / max(1, number):.3f} of {detections} detections, "
            f"median error {np.median(errors or [0]):.2f} pixels of the half image",
            flush=True,
        )


def stacked(examples):
    """One tensor of all examples for each kind."""
    return [torch.from_numpy(np.stack(values)) for values in zip(*examples)]


def train(options):
    network = ObjectNetwork().to(memory_format=torch.channels_last)
    generator = common.begin(network, options)
    images, objects = read(options.folders)
    checked = read(options.check) if options.check else None
    num_batches = len(images) // options.batch
    schedule = common.Schedule(network, options.rate, options.epochs * num_batches)
    random = np.random.default_rng(options.seed)
    for epoch in range(options.epochs):
        network.train()
        total = 0.0
        order = random.permutation(len(images))
        for n in range(num_batches):
            some, targets, weights = [], [], []
            for k in order[n * options.batch : (n + 1) * options.batch]:
                image, labels = moved(images[k], objects[k], random)
                target, weight = targets_of(labels)
                some.append(image.transpose(2, 0, 1))
                targets.append(target)
                weights.append(weight)
            batch = common.recolored(torch.from_numpy(np.stack(some)).float(), generator)
            # Twice as fast as numbers of 32 bits with one plane after the other.
            batch = common.normalized(batch).contiguous(memory_format=torch.channels_last)
            with torch.autocast("cpu", dtype=torch.bfloat16):
                output = network(batch)
            loss = loss_of(output.float(), stacked(targets), stacked(weights))
            schedule.step(loss)
            total += float(loss)
        print(
            f"epoch {epoch + 1}: loss {total / num_batches:.4f}, "
            f"{schedule.minutes():.1f} processor minutes",
            flush=True,
        )
        if checked and (epoch % 5 == 4 or epoch + 1 == options.epochs):
            report(network, *checked)
            common.export(network, options.network, ROWS, COLUMNS)
    common.keep_start(network, options)
    common.export(network, options.network, ROWS, COLUMNS)


if __name__ == "__main__":
    train(common.parse_options(__doc__, "folders", "folders of nao-vision-dataset", epochs=30, batch=32, rate=4e-3))
