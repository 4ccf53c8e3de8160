"""Trains the network that judges patches around possible balls; writes it as ONNX.

The patches are those of nao-vision-patches. Packages: scripts/setup --with train. README.md in this
folder has the commands.
"""

import numpy as np
import torch
from torch import nn

import common

SIZE = 32
# Half of a patch's width, radii of its circle: BallDetector::kPatchRadii.
PATCH_RADII = 2.4
NUM_NUMBERS = 8
RECORD = np.dtype([("patch", "u1", (SIZE, SIZE, 3)), ("numbers", "<f4", NUM_NUMBERS)])
# Outputs besides the log odds: center to the right and downwards, logarithm of the radius.
NUM_TARGETS = 3
# Patches without a ball that are learnt from in every epoch: those to which the network gives this
# probability or more. A fraction of the other patches is used.
HARD_PROBABILITY = 0.003
EASY_FRACTION = 0.15


def make_network():
    """About 40,000 weights and 0.7 million multiplications for a patch."""
    return nn.Sequential(
        common.convolution(3, 8, 5, 2),
        common.convolution(8, 16, 3, 2),
        common.convolution(16, 24, 3),
        common.convolution(24, 32, 3, 2),
        # All of the patch.
        nn.Conv2d(32, 48, 4, bias=False),
        nn.BatchNorm2d(48),
        nn.ReLU(inplace=True),
        nn.Conv2d(48, 1 + NUM_TARGETS, 1),
    )


def mirrored(patches, numbers, generator):
    """A half of them mirrored."""
    is_mirrored = torch.rand(len(patches), generator=generator) < 0.5
    patches = torch.where(is_mirrored[:, None, None, None], patches.flip(3), patches)
    numbers = numbers.clone()
    numbers[is_mirrored, 1] *= -1
    return patches, numbers


def faded(patches, numbers, generator):
    """Of a half of the balls the dark faces become lighter, as on worn balls; a half of all patches is blurred."""
    count = len(patches)
    position = (torch.arange(SIZE) + 0.5) * (2 * PATCH_RADII / SIZE) - PATCH_RADII
    radius = numbers[:, 3].exp()[:, None, None]
    dx = position[None, None, :] - numbers[:, 1, None, None]
    dy = position[None, :, None] - numbers[:, 2, None, None]
    is_inside = ((dx**2 + dy**2 < (0.95 * radius) ** 2) & (numbers[:, 0, None, None] > 0.5))[:, None]
    light = (patches * is_inside).amax(dim=(2, 3), keepdim=True)
    strength = 1.6 * torch.rand(count, 1, 1, 1, generator=generator) - 0.8
    patches = patches + strength.clamp(min=0) * is_inside * (light - patches)
    smooth = nn.functional.avg_pool2d(patches, 3, 1, 1, count_include_pad=False)
    strength = 2 * torch.rand(count, 1, 1, 1, generator=generator) - 1
    return patches + strength.clamp(min=0) * (smooth - patches)


def cut(patches, numbers, generator):
    """A sixth of them loses its lower part, as at the lower border of an image; at most the lower half of a ball."""
    border = SIZE * (0.5 + numbers[:, 2] / (2 * PATCH_RADII) + 0.5 * torch.rand(len(patches), generator=generator))
    border[torch.rand(len(patches), generator=generator) > 1 / 6] = SIZE
    return patches * (torch.arange(SIZE) < border[:, None])[:, None, :, None]


def read(files):
    records = np.concatenate([np.fromfile(file, RECORD) for file in files])
    patches = torch.from_numpy(np.ascontiguousarray(records["patch"].transpose(0, 3, 1, 2)))
    return patches, torch.from_numpy(records["numbers"].copy())


def predict(network, patches):
    """Outputs for all patches, N x 4."""
    network.eval()
    outputs = []
    with torch.no_grad():
        for batch in patches.split(2048):
            outputs.append(network(common.normalized(batch.float())).flatten(1))
    return torch.cat(outputs)


def loss_of(output, numbers):
    is_ball = numbers[:, 0]
    judgement = nn.functional.binary_cross_entropy_with_logits(output[:, 0], is_ball)
    balls = is_ball > 0.5
    if not balls.any():
        return judgement
    places = nn.functional.smooth_l1_loss(
        output[balls, 1:], numbers[balls, 1 : 1 + NUM_TARGETS], beta=0.1
    )
    return judgement + places


def report(network, patches, numbers, name):
    output = predict(network, patches)
    odds = output[:, 0]
    balls = numbers[:, 0] > 0.5
    visible = balls & (numbers[:, 4] >= 0.6)
    text = f"{name}: {len(odds)} patches, {int(balls.sum())} of balls"
    for false_rate in (1e-3, 1e-4):
        others = odds[~balls].sort(descending=True).values
        limit = others[int(false_rate * len(others))]
        text += f", recall {float((odds[visible] > limit).float().mean()):.4f} at {false_rate:g}"
    errors = (output[visible, 1:] - numbers[visible, 1 : 1 + NUM_TARGETS]).abs().median(dim=0)
    text += ", median errors " + " ".join(f"{value:.3f}" for value in errors.values)
    print(text, flush=True)


def train(options):
    network = make_network()
    generator = common.begin(network, options)
    patches, numbers = read(options.patches)
    checked = read(options.check) if options.check else None
    # Epochs differ in length; this many steps, with all of the patches in the first.
    is_hard = numbers[:, 0] > 0.5
    per_epoch = int(is_hard.sum()) + int(0.35 * len(patches))
    num_steps = options.epochs * (per_epoch // options.batch)
    schedule = common.Schedule(network, options.rate, num_steps)
    step = 0
    epoch = 0
    while step < num_steps:
        if epoch % 3 == 1:
            odds = predict(network, patches)[:, 0]
            is_hard = (odds.sigmoid() > HARD_PROBABILITY) | (numbers[:, 0] > 0.5)
        is_used = torch.rand(len(patches), generator=generator) < EASY_FRACTION
        order = (is_used | is_hard | (epoch == 0)).nonzero().flatten()
        order = order[torch.randperm(len(order), generator=generator)]
        network.train()
        total = 0.0
        num_batches = min(len(order) // options.batch, num_steps - step)
        for batch in order.split(options.batch)[:num_batches]:
            some, targets = mirrored(patches[batch].float(), numbers[batch], generator)
            some = faded(some, targets, generator)
            some = cut(common.recolored(some, generator), targets, generator)
            loss = loss_of(network(common.normalized(some)).flatten(1), targets)
            schedule.step(loss)
            total += float(loss)
        step += num_batches
        epoch += 1
        print(
            f"epoch {epoch}: {len(order)} patches, loss {total / num_batches:.5f}, "
            f"{schedule.minutes():.1f} processor minutes",
            flush=True,
        )
        if checked and (epoch % 5 == 0 or step == num_steps):
            report(network, *checked, "check")
    common.export(network, options.network, SIZE, SIZE)


if __name__ == "__main__":
    train(common.parse_options(__doc__, "patches", "files of nao-vision-patches", epochs=20, batch=256, rate=4e-3))
