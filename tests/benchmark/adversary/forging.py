# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a mesh that its owner never marked can be made to read as the owner's, or anybody's.

By transplanting: which side each shell's mean is on can be seen in a marked mesh without the key; another mesh whose
means are pushed to the same sides may read as marked with that key. By search: tries keys of the adversary's on an
unmarked mesh, and says how small p got, what a key costs, and what that makes for p < 1e-6.

    build/venv/bin/python tests/benchmark/adversary/forging.py --keys 200
"""

import argparse
import ctypes
import time

import numpy as np
from shapes import Shape, embed, likeliest_shells, log_p, mrms, norms_of, opened, shells, with_means

SALT, PASSES, MEMORY, ARGON2ID = b"filter_watermark", 2, 64 << 20, 2  # as vcg_ext/key/key.cpp has them


def main() -> None:
    """Prints the figures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mesh", default="homer")
    parser.add_argument("--keys", type=int, default=200)
    parser.add_argument("--method", default="L-M")
    parser.add_argument("--owners", type=int, default=3, help="keys of owners that are tried so")
    parser.add_argument("--onto", default="fandisk", help="the mesh that a mark is transplanted to")
    options = parser.parse_args()
    shape = opened(options.mesh)
    for i in range(options.owners):
        transplant(shape, opened(options.onto), options.method, f"owner {i}")
    log_p(shape, options.method, "warm-up")
    begin = time.process_time()
    logs = np.array([log_p(shape, options.method, f"key {i}") for i in range(options.keys)])
    each = (time.process_time() - begin) / options.keys
    print(f"{options.keys} keys on unmarked {options.mesh}: least p 10^{logs.min():.1f};", end=" ")
    print(", ".join(f"p <= {level:g}: {(10.0**logs <= level).mean():.3f}" for level in (0.1, 0.01)))
    kdf = derivation_seconds()
    print(f"CPU seconds a key: {each:.2f}, of these {kdf:.3f} are its derivation")
    print(
        f"p < 1e-6 by search: {1e6 * each / 3600:.0f} hours of one core, {1e6 * kdf / 3600:.0f} for derivations alone"
    )


def transplant(shape: Shape, onto: Shape, method: str, key: str) -> None:
    """Prints what the owner's key reads of a mesh that got the sides of the shells from a marked one."""
    marked = embed(shape, method, key)
    _, seen = likeliest_shells(marked)
    means = 0.5 + 0.1 * np.sign(seen.means)
    forged = onto
    for _ in range(3):  # the centre moves along
        forged = with_means(forged, shells(norms_of(forged), seen.count, seen.trim), means)
    print(f"transplanted: {seen.count} shells, trim {seen.trim:.4f}, MRMS {mrms(forged, onto):.1e};", end=" ")
    print(f"the owner's key reads p 10^{log_p(forged, method, key):.1f}")


def derivation_seconds(times: int = 10) -> float:
    sodium = ctypes.CDLL("libsodium.so.23")
    key = ctypes.create_string_buffer(32)
    begin = time.process_time()
    for i in range(times):
        secret = b"key %d" % i
        failed = sodium.crypto_pwhash(
            key, ctypes.c_ulonglong(32), secret, ctypes.c_ulonglong(len(secret)), SALT, ctypes.c_ulonglong(PASSES),
            ctypes.c_size_t(MEMORY), ctypes.c_int(ARGON2ID),
        )  # fmt: skip
        if failed:
            raise MemoryError("Argon2id needs 64 MiB")
    return (time.process_time() - begin) / times


if __name__ == "__main__":
    main()
