# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the test vectors of key_test.cpp by a second implementation: argon2-cffi, hashlib's BLAKE2b, and RFC 8439's
ChaCha20 core (with the original 64-bit counter) written out here. Needs `pip install argon2-cffi`."""

import hashlib
import itertools
import struct
from collections.abc import Iterator

from argon2.low_level import Type, hash_secret_raw


def chacha20(key: bytes) -> Iterator[bytes]:
    def rotate(x: int, n: int) -> int:
        return (x << n | x >> (32 - n)) & 0xFFFFFFFF

    def quarter(s: list[int], a: int, b: int, c: int, d: int) -> None:
        for first, second, third, by in ((a, b, d, 16), (c, d, b, 12), (a, b, d, 8), (c, d, b, 7)):
            s[first] = (s[first] + s[second]) & 0xFFFFFFFF
            s[third] = rotate(s[third] ^ s[first], by)

    for counter in itertools.count():
        start = [0x61707865, 0x3320646E, 0x79622D32, 0x6B206574, *struct.unpack("<8I", key), counter, 0, 0, 0]
        s = start[:]
        for _ in range(10):
            for i in range(4):
                quarter(s, i, i + 4, i + 8, i + 12)
            for i in range(4):
                quarter(s, i, (i + 1) % 4 + 4, (i + 2) % 4 + 8, (i + 3) % 4 + 12)
        yield struct.pack("<16I", *((x + y) & 0xFFFFFFFF for x, y in zip(s, start, strict=True)))


def words(secret: bytes, purpose: bytes) -> Iterator[int]:
    master = hash_secret_raw(secret, b"filter_watermark", 2, 64 * 1024, 1, 32, Type.ID)
    subkey = hashlib.blake2b(purpose, key=master, digest_size=32).digest()
    for block in chacha20(subkey):
        yield from struct.unpack("<8Q", block)


def below(source: Iterator[int], n: int) -> int:
    return next(w % n for w in source if w < 2**64 - 2**64 % n)


def permutation(source: Iterator[int], n: int) -> list[int]:
    order = list(range(n))
    for i in range(n - 1, 0, -1):
        j = below(source, i + 1)
        order[i], order[j] = order[j], order[i]
    return order


def main() -> None:
    for secret, purpose in ((b"correct horse", b"epsilon"), ("Schlüssel".encode(), b"bit-mask")):
        source = words(secret, purpose)
        drawn = [next(source) for _ in range(130)]
        print(secret, purpose, *(hex(drawn[i]) for i in (0, 1, 7, 8, 63, 64, 129)))
    print("permutation of 16:", permutation(words(b"correct horse", b"carrier-order"), 16))
    source = words(b"correct horse", b"epsilon")
    print("below 15001:", [below(source, 15001) for _ in range(4)])
    source = words(b"correct horse", b"epsilon")
    print("below 2^63 + 1:", [below(source, 2**63 + 1) for _ in range(4)])


if __name__ == "__main__":
    main()
