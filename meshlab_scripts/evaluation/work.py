# SPDX-License-Identifier: GPL-3.0-or-later
"""How a job is done. Each is a function of the job alone; marked meshes and found strengths are kept for the next."""

import json
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pymeshlab
from meshmark import Refused, host, plugin
from meshmark.formats import weld
from meshmark.host import Value

from . import frames
from .channels import CHANNELS, Shape
from .channels.shape import Passage
from .filters import Numbers, apply, opened, replaced, save
from .jobs import METHODS, Job, Site, mesh_file

# What the plugin takes.
STRENGTHS = {"Mean": (0.002, 0.45), "Variance": (0.002, 0.3), "Spectral": (2.0, 1000.0), "Waves": (1e-5, 2e-3),
             "Layered": (1e-5, 2e-3)}  # fmt: skip
STEPS = 20  # of the search for a strength, at most
CLOSE = 0.01  # it ends where the mark is this near to its limit


def run(job: Job, site: Site, after: object = None) -> tuple[Numbers, str]:
    """The job's results, or why there are none. `after` is only waited for: the job that this one needs."""
    try:
        plugin.load(site.plugin)
        return WORK[job.kind](job, site), ""
    except Exception as error:  # whatever it is, it belongs to this job, and the others go on
        return {}, " ".join(str(error).split()) or repr(error)


def embed(job: Job, site: Site) -> Numbers:
    """Marks the mesh, measures the mark against the cover, and reads it back from the file."""
    cover = mesh_file(site.meshes, job.mesh)
    strength = _strength(job, site)
    with opened(cover, cover) as meshes:
        results = apply(meshes, plugin.EMBED, message=job.message, strength=strength, **_carriers(job))
        save(meshes, _marked(job, site))
        distortion = apply(meshes, plugin.MEASURE, reference=0)
    results["seconds"] = sum(
        value for name, value in results.items() if name.startswith("seconds_") and name != "seconds_measure"
    )
    moved = sum(value for name, value in results.items() if name.startswith("moves_"))
    results |= {name: value / moved for name, value in results.items() if name.startswith("moves_")}
    with opened(_marked(job, site)) as meshes:
        return results | distortion | _read(meshes, job)


def attack(job: Job, site: Site) -> Numbers:
    """Attacks the marked mesh and reads the mark; on request with the original, too."""
    marked = _marked(job.mark, site)
    if not marked.exists():
        embed(job.mark, site)
    with opened(marked) as meshes:
        results = _attack(meshes, job)
        found = {name: results[name] for name in ("vertices", "faces")} | _read(meshes, job)
        return found | _read_with_original(meshes, job, site) if job.original else found


def null(job: Job, site: Site) -> Numbers:
    """Looks for the mark where there is none."""
    with opened(mesh_file(site.meshes, job.mesh)) as meshes:
        return _read(meshes, job)


def align(job: Job, site: Site) -> Numbers:
    """How far the attack moves the frame of the mesh: centres in parts of the diagonal, axes in degrees."""
    with opened(mesh_file(site.meshes, job.mesh)) as meshes:
        before = _frames(meshes)
        diagonal = meshes.current_mesh().bounding_box().diagonal()
        _attack(meshes, job)
        after = _frames(meshes)
    results: Numbers = {}
    for way in frames.WAYS:
        distance, angle = frames.shift(before[way], after[way])
        results |= {f"centre_{way}": distance / diagonal, f"axis_{way}": angle}
    return results


WORK: dict[str, Callable[[Job, Site], Numbers]] = {"embed": embed, "attack": attack, "null": null, "align": align}


def _carriers(job: Job) -> dict[str, Value]:
    method, statistic = METHODS[job.method]
    return {"method": method, "statistic": statistic, "key": job.secret, "bits": job.bits, "trim": job.trim}


def _read(meshes: pymeshlab.MeshSet, job: Job) -> Numbers:
    found = apply(meshes, plugin.DETECT, expected=job.message, **_carriers(job))
    return {
        "detection_ratio": found["detection_ratio"],
        "p_value": found["p_binomial"],
        "log10_p": math.log10(found["p_value"]),  # key and message known
        "log10_p_alone": math.log10(found["p_message"]),  # the key alone
    }


def _read_with_original(meshes: pymeshlab.MeshSet, job: Job, site: Site) -> Numbers:
    suspect = meshes.current_mesh_id()
    host.read(meshes, mesh_file(site.meshes, job.mesh))
    original = meshes.current_mesh_id()
    meshes.set_current_mesh(suspect)
    found = apply(meshes, plugin.DETECT_WITH_ORIGINAL, expected=job.message, original=original, **_carriers(job))
    return {
        "detection_ratio_original": found.get("detection_ratio", 0.5),  # where the two do not fit, a coin's
        "log10_p_original": math.log10(found["p_value"]),
        "log10_p_alone_original": math.log10(found["p_message"]),  # the original and the key, no message
    }


def _attack(meshes: pymeshlab.MeshSet, job: Job) -> Numbers:
    if job.attack in CHANNELS:
        return _pass_through(meshes, job)
    amount = job.amount
    if job.unit == "mean norm":
        points = meshes.current_mesh().vertex_matrix()
        norms = np.linalg.norm(points - points.mean(axis=0), axis=1)
        amount *= norms.mean() / norms.max()
    values = {"attack": job.attack, "amount": amount, "iterations": job.iterations, "seed": job.key}
    return apply(meshes, plugin.ATTACK, **values)


def _pass_through(meshes: pymeshlab.MeshSet, job: Job) -> Numbers:
    """What comes out of a channel is a new layer, the current one."""
    mesh = meshes.current_mesh()
    sent = Shape(mesh.vertex_matrix().copy(), mesh.face_matrix().copy())
    got = CHANNELS[job.attack](sent, Passage(job.amount, job.iterations, job.key))
    points, number = weld(got.points)
    meshes.add_mesh(pymeshlab.Mesh(points, number[got.faces].astype(np.int32)))
    return {"vertices": len(points), "faces": len(got.faces)}


def _frames(meshes: pymeshlab.MeshSet) -> dict[str, tuple[frames.Array, frames.Array]]:
    mesh = meshes.current_mesh()
    return frames.frames(mesh.vertex_matrix(), mesh.face_matrix())


def _marked(job: Job, site: Site) -> Path:
    return site.cache / f"{job.name}.ply"


def _strength(job: Job, site: Site) -> float:
    """The job's strength, or the strongest of its mesh, method and key that keeps its limits."""
    strength = _found(job, site) if job.limits else job.strength
    if strength is None:
        raise ValueError(f"No strength at which the mark reads back keeps the limits {dict(job.limits)}.")
    return strength


def _found(job: Job, site: Site) -> float | None:
    """What was found, or that there is none, is kept: the mark's attacks ask again where it could not be made."""
    known = site.cache / f"{job.name}.json"
    if not known.exists():
        first = _found(job.before, site) if job.key else None  # that of another key is near
        with replaced(known) as part:
            part.write_text(json.dumps(_strongest(job, site, first)), encoding="utf-8")
    return json.loads(known.read_text(encoding="utf-8"))


def _strongest(job: Job, site: Site, first: float | None) -> float | None:
    """From the first, or else from the top, to the strongest mark that keeps the limits, as if distortion grew with
    the strength.

    What does not read back is refused: below the first mark that reads, but breaks the limits, it is too weak, and
    elsewhere too strong.
    """
    least, most = STRENGTHS.get(job.method, STRENGTHS[METHODS[job.method][1]])
    strength, low, high, kept = first or most, 0.0, math.inf, 0.0
    seen: list[tuple[float, float]] = []  # strengths of marks that read, and what they distort
    for _ in range(STEPS):
        excess = _excess(job, strength, site)
        if excess == math.inf and strength == first:  # too weak or too strong: the top tells
            first, strength = None, most
            continue
        if excess <= 1:
            kept = low = strength
        elif excess == math.inf and seen and not kept:
            low = strength
        else:
            high = strength
        if excess < math.inf:
            seen.append((strength, excess))
        if 1 - CLOSE <= excess <= 1 or kept == most or high < (1 + CLOSE) * low or high == least:
            break
        strength = min(most, _aimed(seen))
        if not low < strength < high:
            strength = math.sqrt(low * high) if low else high / 2
        strength = max(least, strength)
    return kept or None


def _aimed(seen: list[tuple[float, float]]) -> float:
    """The strength just within the limits, where distortion is a line through the last two; in proportion to the last
    where there is no other, or the line does not rise from above nothing.
    """
    aim = 1 - CLOSE / 2
    if not seen:
        return 0.0
    strength, excess = seen[-1]
    if len(seen) > 1:
        before, more = seen[-2]
        rise = (more - excess) / (before - strength)
        line = strength + (aim - excess) / rise if rise > 0 else 0.0
        if line > 0:
            return line
    return strength * aim / excess


def _excess(job: Job, strength: float, site: Site) -> float:
    """The mark's distortion over its limits, the worst of them; infinite where the mark does not read back."""
    cover = mesh_file(site.meshes, job.mesh)
    with opened(cover, cover) as meshes:
        try:
            results = apply(meshes, plugin.EMBED, message=job.message, strength=strength, **_carriers(job))
        except Refused:
            return math.inf
        missing = [name for name, _ in job.limits if name not in results]
        if missing:  # MSDM, which takes no samples
            results = apply(meshes, plugin.MEASURE, reference=0, samples=1) | results
        excess = _worst(job, results)
        if excess > 1 or len(missing) == len(job.limits):
            return excess
        return _worst(job, apply(meshes, plugin.MEASURE, reference=0))  # as reported


def _worst(job: Job, results: Numbers) -> float:
    return max(results[name] / limit for name, limit in job.limits)
