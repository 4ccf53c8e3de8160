"""Writes, and reads again, a network of fully connected layers with ELU between them as an ONNX file, as torch.onnx.export names and orders it.

Only what such a file needs of the format (https://github.com/onnx/onnx, onnx.proto3): messages are fields of a number, a wire
type (0: integer, 2: bytes) and a value.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Iterable, Iterator, Sequence

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from output_file import replace_file  # noqa: E402

# TensorProto.FLOAT, AttributeProto.FLOAT and INT.
FLOAT, ATTRIBUTE_FLOAT, ATTRIBUTE_INT = 1, 1, 2
OPSET = 11


def varint(value: int) -> bytes:
    parts = bytearray()
    while value > 0x7F:
        parts.append(value & 0x7F | 0x80)
        value >>= 7
    parts.append(value)
    return bytes(parts)


def number(field: int, value: int) -> bytes:
    return varint(field << 3) + varint(value)


def data(field: int, value: bytes | str) -> bytes:
    encoded = value.encode() if isinstance(value, str) else value
    return varint(field << 3 | 2) + varint(len(encoded)) + encoded


def node(kind: str, inputs: Iterable[str], output: str, attributes: bytes = b"") -> bytes:
    return b"".join(data(1, name) for name in inputs) + data(2, output) + data(3, output) + data(4, kind) + attributes


def tensor(name: str, value: np.ndarray) -> bytes:
    shape = b"".join(number(1, size) for size in value.shape)
    return shape + number(2, FLOAT) + data(8, name) + data(9, value.astype("<f4").tobytes())


def value_info(name: str, size: int) -> bytes:
    shape = data(1, number(1, 1)) + data(1, number(1, size))
    return data(1, name) + data(2, data(1, number(1, FLOAT) + data(2, shape)))


def write_mlp(file: Path, layers: Sequence[tuple[np.ndarray, np.ndarray]]) -> None:
    """@param layers  Weights (outputs x inputs) and biases of each layer."""
    graph, tensors, name = b"", b"", "obs"
    for k, (weight, bias) in enumerate(layers):
        tensors += data(5, tensor(f"{2 * k}.weight", weight)) + data(5, tensor(f"{2 * k}.bias", bias))
        transposed = data(5, data(1, "transB") + number(3, 1) + number(20, ATTRIBUTE_INT))
        is_last = k == len(layers) - 1
        output = "actions" if is_last else f"/{2 * k}/Gemm_output_0"
        graph += data(1, node("Gemm", [name, f"{2 * k}.weight", f"{2 * k}.bias"], output, transposed))
        if not is_last:
            graph += data(1, node("Elu", [output], f"/{2 * k + 1}/Elu_output_0"))
            output = f"/{2 * k + 1}/Elu_output_0"
        name = output
    graph += data(2, "main_graph") + tensors
    graph += data(11, value_info("obs", layers[0][0].shape[1])) + data(12, value_info("actions", layers[-1][0].shape[0]))
    replace_file(file, number(1, 7) + data(2, "nao-remote") + data(7, graph) + data(8, data(1, "") + number(2, OPSET)))


def fields(message: bytes) -> Iterator[tuple[int, int | bytes]]:
    """@return Number and value of each field of a message that this module wrote."""
    at = 0

    def next_varint() -> int:
        nonlocal at
        value = shift = 0
        while True:
            byte = message[at]
            at += 1
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value

    while at < len(message):
        key = next_varint()
        value: int | bytes = next_varint()
        if key & 7 == 2:
            size = int(value)
            value, at = message[at:at + size], at + size
        yield key >> 3, value


def read_mlp(file: Path) -> list[tuple[np.ndarray, np.ndarray]]:
    """@return Layers, as write_mlp() took them. @throws OSError, and ValueError if the file is another one or damaged."""
    arrays = []
    message = file.read_bytes()
    try:
        graph = next(value for field, value in fields(message) if field == 7)
        for field, value in fields(graph):
            if field == 5:
                tensor_fields = list(fields(value))
                shape = [size for number, size in tensor_fields if number == 1]
                raw = next(content for number, content in tensor_fields if number == 9)
                arrays.append(np.frombuffer(raw, "<f4").reshape(shape).copy())
    except (IndexError, OverflowError, StopIteration, TypeError, ValueError) as error:
        raise ValueError("it is damaged, or not a policy.onnx of this trainer") from error
    return list(zip(arrays[::2], arrays[1::2]))
