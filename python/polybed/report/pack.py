"""Arrays as they stand in a page: whole numbers of one or two bytes, compressed, as text; the script of the page unpacks them."""

import base64
import zlib

import numpy as np

EMPTY = 255  # of a map where there is nothing to show; levels are 0 to 254, so that 127 is the middle of a scale with two signs


def packed(values):
    """Text of an array of bytes or of two-byte numbers, little end first."""
    plain = np.ascontiguousarray(values).astype(values.dtype.newbyteorder("<"))
    return base64.b64encode(zlib.compress(plain.tobytes(), 6)).decode()


def levels(values, low, high, kind=np.uint8):
    """Values as levels of one byte or two between the ends of a scale, which can be arrays; the highest is empty, of what is no number."""
    empty = np.iinfo(kind).max
    share = (np.asarray(values, np.float32 if kind is np.uint8 else float) - low) / np.where(np.greater(high, low), np.subtract(high, low), 1)
    with np.errstate(invalid="ignore"):
        found = np.rint(np.clip(share, 0, 1) * (empty - 1))
    return np.where(np.isfinite(found), found, empty).astype(kind)


def changes(values):
    """Two-byte numbers [step][...] as the change from step to step, low bytes and high bytes apart: what moves little is short when
    compressed."""
    change = np.diff(values, axis=0, prepend=np.zeros_like(values[:1])).astype(np.uint16)
    return np.concatenate([(change & 255).astype(np.uint8).ravel(), (change >> 8).astype(np.uint8).ravel()])


def plain_numbers(values, digits=5):
    """Numbers for JSON, to some digits; null for what is none."""
    return [float(f"{value:.{digits}g}") if np.isfinite(value) else None for value in np.asarray(values, dtype=float)]


def thinned(count, most):
    """Numbers of at most so many of `count` entries, the last one among them, evenly."""
    stride = max(1, -(-count // most))
    return np.arange(count)[::-1][::stride][::-1]
