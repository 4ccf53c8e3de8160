"""What the trainings of both networks share."""

import argparse
import copy
import io
import sys
import time
from pathlib import Path

import cv2
import torch
from torch import nn

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from output_file import replace_file  # noqa: E402

# As in daemons/vision/neural_network.cpp.
LEAST_DEVIATION = 4.0


def convolution(inputs, outputs, size, stride=1, dilation=1):
    """Convolution that keeps the size or halves it, batch normalization, ReLU."""
    padding = dilation * (size - 1) // 2
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, size, stride, padding, dilation, bias=False),
        nn.BatchNorm2d(outputs),
        nn.ReLU(inplace=True),
    )


def normalized(images):
    """Mean 0 and standard deviation 1, as NeuralNetwork does. images: N x 3 x rows x columns."""
    mean = images.mean(dim=(1, 2, 3), keepdim=True)
    deviation = images.std(dim=(1, 2, 3), keepdim=True, unbiased=False)
    return (images - mean) / (deviation + LEAST_DEVIATION)


def noise(shape, generator, pool=[]):
    """Normal noise; pieces of one long sequence, since drawing it anew would take most of the time."""
    size = shape[1] * shape[2] * shape[3]
    if not pool or len(pool[0]) < 2 * size:
        pool[:] = [torch.randn(max(2 * size, 100000), generator=generator)]
    starts = torch.randint(0, len(pool[0]) - size, (shape[0],), generator=generator)
    return torch.stack([pool[0][i : i + size] for i in starts.tolist()]).reshape(shape)


def recolored(images, generator):
    """Other white balance, saturation, exposure and noise; levels of 255."""
    count = images.shape[0]

    def uniform(low, high, *shape):
        return low + (high - low) * torch.rand(*shape, generator=generator)

    grey = images.mean(dim=1, keepdim=True)
    images = grey + uniform(0.6, 1.4, count, 1, 1, 1) * (images - grey)
    images = images * uniform(0.85, 1.18, count, 3, 1, 1) + uniform(-12, 25, count, 1, 1, 1)
    # A quarter is overexposed.
    gain = torch.where(
        torch.rand(count, 1, 1, 1, generator=generator) < 0.25,
        uniform(1.0, 2.2, count, 1, 1, 1),
        uniform(0.6, 1.1, count, 1, 1, 1),
    )
    # Half get another tone curve.
    curved = 255 * (images.clamp(0, 255) / 255) ** uniform(-0.45, 0.45, count, 1, 1, 1).exp()
    images = torch.where(torch.rand(count, 1, 1, 1, generator=generator) < 0.5, curved, images)
    strength = uniform(0, 6, count, 1, 1, 1)
    return (gain * images + strength * noise(images.shape, generator)).clamp(0, 255)


class Schedule:
    """Learning rate that rises for a short time and falls as a cosine; time of the processor."""

    def __init__(self, network, rate, num_steps):
        self.optimizer = torch.optim.AdamW(network.parameters(), lr=rate, weight_decay=1e-3)
        self.rates = torch.optim.lr_scheduler.OneCycleLR(
            self.optimizer, rate, total_steps=num_steps, pct_start=0.1
        )
        self.begin = time.process_time()

    def step(self, loss):
        self.optimizer.zero_grad()
        loss.backward()
        self.optimizer.step()
        self.rates.step()

    def minutes(self):
        return (time.process_time() - self.begin) / 60


def export(network, file, rows, columns):
    """Writes the network as ONNX, for any number of images."""
    network.eval()
    model = io.BytesIO()
    torch.onnx.export(
        network,
        torch.zeros(1, 3, rows, columns),
        model,
        input_names=["images"],
        output_names=["outputs"],
        dynamic_axes={"images": {0: "count"}, "outputs": {0: "count"}},
        opset_version=11,
    )
    replace_file(file, model.getvalue())
    print(f"{file}: {Path(file).stat().st_size} bytes")


def parse_options(description, inputs, inputs_help, epochs, batch, rate):
    """Command line of a training. inputs: name of the list of what is learnt from."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("network", help="ONNX file to write")
    parser.add_argument(inputs, nargs="+", help=inputs_help)
    parser.add_argument("--check", nargs="*", help="the same, which are reported and not learnt from")
    parser.add_argument("--start", help="network (.onnx) of an earlier training to start from")
    parser.add_argument("--keep", type=float, default=0, help="fraction of --start in the mean of both networks' weights, 0 to 1")
    parser.add_argument("--epochs", type=int, default=epochs)
    parser.add_argument("--batch", type=int, default=batch)
    parser.add_argument("--rate", type=float, default=rate, help="greatest learning rate")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    return parser.parse_args()


def load(network, file):
    """Takes the weights from an ONNX file, in which batch normalization is a part of the convolutions: it ends here, too."""
    layers = cv2.dnn.readNetFromONNX(file)
    modules = dict(network.named_modules())
    for name in layers.getLayerNames():
        layer = layers.getLayer(layers.getLayerId(name))
        if layer.type == "Convolution":
            # onnx_node!/fine/fine.1/fine.1.0/Conv
            convolution = modules[name.split("/")[-2]]
            convolution.weight = nn.Parameter(torch.from_numpy(layer.blobs[0].copy()))
            if len(layer.blobs) > 1:
                convolution.bias = nn.Parameter(torch.from_numpy(layer.blobs[1].flatten().copy()))
    for module in list(network.modules()):
        for name, part in module.named_children():
            if isinstance(part, nn.BatchNorm2d):
                setattr(module, name, nn.Identity())


def keep_start(network, options):
    """Mixes in the weights of --start: what it could do is kept, and less learnt anew.

    Source: Wortsman and others, Robust fine-tuning of zero-shot models, CVPR 2022."""
    if not options.start or options.keep == 0:
        return
    start = copy.deepcopy(network)
    load(start, options.start)
    with torch.no_grad():
        for weights, others in zip(network.parameters(), start.parameters()):
            weights.lerp_(others, options.keep)


def begin(network, options):
    torch.manual_seed(options.seed)
    torch.set_num_threads(options.threads)
    if options.start:
        load(network, options.start)
    print(f"{sum(p.numel() for p in network.parameters())} weights", flush=True)
    return torch.Generator().manual_seed(options.seed)
