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


def distances(numbers):
    """Distance of each pixel from the ball's center, in radii of the ball, N x 1 x 32 x 32; without a ball far away."""
    position = (torch.arange(SIZE) + 0.5) * (2 * PATCH_RADII / SIZE) - PATCH_RADII
    dx = position[None, None, :] - numbers[:, 1, None, None]
    dy = position[None, :, None] - numbers[:, 2, None, None]
    distance = (dx**2 + dy**2).sqrt() / numbers[:, 3].exp()[:, None, None]
    return torch.where(numbers[:, 0, None, None] > 0.5, distance, 100.0)[:, None]


def pasted(patches, numbers, generator):
    """A third of the whole balls is cut out and put into other patches: on lines, crossings, robots, boards."""
    count = len(patches)
    other = torch.randperm(count, generator=generator)
    chosen = (numbers[:, 0] > 0.5) & (numbers[:, 4] > 0.97) & (numbers[other, 0] < 0.5)
    chosen &= torch.rand(count, generator=generator) < 1 / 3
    edge = SIZE / (2 * PATCH_RADII) * numbers[:, 3].exp()[:, None, None, None]
    alpha = (edge * (1.02 - distances(numbers)) + 0.5).clamp(0, 1)
    # As light as the lightest of the other patch, or as before.
    light = patches.amax(dim=(1, 2, 3), keepdim=True)
    gain = (light[other] / light.clamp(min=1)).clamp(0.3, 3)
    gain = gain ** torch.rand(count, 1, 1, 1, generator=generator)
    mixed = patches[other] + alpha * (gain * patches - patches[other])
    return torch.where(chosen[:, None, None, None], mixed, patches)


def faded(patches, numbers, generator):
    """Makes the dark faces of half of the balls lighter, as on worn balls."""
    inside = (distances(numbers) < 0.95).float()
    light = (patches * inside).amax(dim=(2, 3), keepdim=True)
    strength = 1.7 * torch.rand(len(patches), 1, 1, 1, generator=generator) - 0.85
    return patches + strength.clamp(min=0) * inside * (light - patches)


def blurred(patches, generator):
    """A half of them by motion, up to 5 pixels of the patch, and a half by the lens."""
    kernels = torch.zeros(16, 1, 5, 5)
    for i, kernel in enumerate(kernels[:, 0]):
        angle = torch.rand((), generator=generator) * torch.pi
        length = 2 * torch.rand((), generator=generator)
        for at in torch.linspace(-1, 1, 9):
            x, y = 2 + at * length * angle.cos(), 2 + at * length * angle.sin()
            kernel[int(y.round()), int(x.round())] += 1 / 9
    moved = []
    for part, kernel in zip(patches.chunk(16), kernels):
        smooth = nn.functional.pad(part, (2, 2, 2, 2), mode="replicate")
        moved.append(nn.functional.conv2d(smooth, kernel.expand(3, 1, 5, 5), groups=3))
    is_moved = torch.rand(len(patches), 1, 1, 1, generator=generator) < 0.5
    patches = torch.where(is_moved, torch.cat(moved), patches)
    smooth = nn.functional.avg_pool2d(patches, 3, 1, 1, count_include_pad=False)
    # Negative strengths sharpen, as cameras do.
    strength = 2 * torch.rand(len(patches), 1, 1, 1, generator=generator) - 1
    strength = torch.where(strength > -0.6, strength.clamp(min=0), 1.5 * strength + 0.9)
    return (patches + strength * (smooth - patches)).clamp(0, 255)


def in_glare(patches, generator):
    """A quarter of them becomes lighter towards one side."""
    count = len(patches)
    angle = 2 * torch.pi * torch.rand(count, 1, 1, generator=generator)
    position = torch.linspace(-1, 1, SIZE)
    slope = position[None, None, :] * angle.cos() + position[None, :, None] * angle.sin()
    strength = 150 * torch.rand(count, 1, 1, generator=generator)
    strength[torch.rand(count, generator=generator) > 0.25] = 0
    return patches + (strength * (0.5 + slope).clamp(0, 1.5))[:, None]


def cut(patches, numbers, generator):
    """A sixth of them loses a part, as at the borders of an image; most lose the lower one, at most 0.6 of a ball."""
    count = len(patches)
    radius = numbers[:, 3].exp() * (numbers[:, 0] > 0.5)
    shift = torch.rand(count, generator=generator) * 1.3 - 0.25
    at = torch.arange(SIZE)[None] + 0.5
    lower = SIZE * (0.5 + (numbers[:, 2] + shift * radius) / (2 * PATCH_RADII))
    right = SIZE * (0.5 + (numbers[:, 1] + (0.15 + shift.abs()) * radius) / (2 * PATCH_RADII))
    kind = torch.rand(count, generator=generator)
    lower[kind > 0.13] = SIZE
    right[(kind < 0.13) | (kind > 0.17)] = SIZE
    patches = patches * (at < lower[:, None])[:, None, :, None]
    # Patches are mirrored: also at the left border.
    return patches * (at < right[:, None])[:, None, None, :]


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
        # A network to start from judges already before the first epoch.
        if epoch % 3 == (0 if options.start else 1):
            odds = predict(network, patches)[:, 0]
            is_hard = (odds.sigmoid() > HARD_PROBABILITY) | (numbers[:, 0] > 0.5)
        is_used = torch.rand(len(patches), generator=generator) < EASY_FRACTION
        order = (is_used | is_hard | (epoch == 0 and not options.start)).nonzero().flatten()
        order = order[torch.randperm(len(order), generator=generator)]
        network.train()
        total = 0.0
        num_batches = min(len(order) // options.batch, num_steps - step)
        for batch in order.split(options.batch)[:num_batches]:
            some, targets = patches[batch].float(), numbers[batch]
            some = faded(pasted(some, targets, generator), targets, generator)
            some = in_glare(blurred(some, generator), generator)
            some = cut(common.recolored(some, generator), targets, generator)
            some, targets = mirrored(some, targets, generator)
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
    common.keep_start(network, options)
    common.export(network, options.network, SIZE, SIZE)


if __name__ == "__main__":
    train(common.parse_options(__doc__, "patches", "files of nao-vision-patches", epochs=20, batch=256, rate=4e-3))
