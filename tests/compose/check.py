#!/usr/bin/env python3
"""Uploads an instanced GLB and an instanced OBJ with curl, and checks what comes back.

usage: check.py BASE_URL SCENE.glb
"""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile


def curl(*arguments):
    """The status, the headers (lower case) and the body."""
    with tempfile.TemporaryDirectory() as folder:
        head, body = pathlib.Path(folder, "head"), pathlib.Path(folder, "body")
        status = subprocess.run(
            ["curl", "--silent", "--show-error", "--max-time", "60", "-D", head, "-o", body, "-w", "%{http_code}"]
            + list(arguments),
            check=True, capture_output=True, text=True,
        ).stdout
        headers = dict(re.findall(r"(?m)^([\w-]+): *(.*?)\r?$", head.read_text()))
        # curl keeps the heads of interim answers too; the last value of a name is that of the answer
        return int(status), {name.lower(): value for name, value in headers.items()}, body.read_bytes()


def must(condition, message):
    if not condition:
        sys.exit(f"check.py: {message}")


def bumpy_grid(size, instances):
    """A height field of 2 * size^2 triangles that stands `instances` times in a row."""
    lines = ["#@iobj 1.0", "o hill"]
    for y in range(size + 1):
        for x in range(size + 1):
            lines.append(f"v {x} {y} {math.sin(x * 0.7) * math.cos(y * 0.5):.4f}")
    for y in range(size):
        for x in range(size):
            a = y * (size + 1) + x + 1
            b, c, d = a + 1, a + size + 1, a + size + 2
            lines += [f"f {a} {b} {d}", f"f {a} {d} {c}"]
    for i in range(instances):
        lines.append(f"#@instance hill hill-{i} 1 0 0 {i * (size + 2)} 0 1 0 0 0 0 1 0 0 0 0 1")
    return "\n".join(lines) + "\n"


def optimize(base, file, media_type, ratio):
    status, headers, body = curl(
        "--data-binary", f"@{file}", "-H", f"Content-Type: {media_type}", f"{base}/v1/optimize?ratio={ratio}"
    )
    must(status == 200, f"{file}: status {status}: {body[:500]!r}")
    sent = pathlib.Path(file).stat().st_size
    must(int(headers["coppice-input-bytes"]) == sent, f"Coppice-Input-Bytes is not {sent}: {headers}")
    must(int(headers["coppice-output-bytes"]) == len(body), f"Coppice-Output-Bytes is not {len(body)}: {headers}")
    before, after = map(int, headers["coppice-triangles"].split(";"))
    must(after <= before * ratio * 1.01 + 2, f"{before} triangles became {after} at ratio {ratio}")
    must("coppice-cache" in headers, f"no Coppice-Cache: {headers}")
    for stage in ("read", "simplify", "write"):
        must(re.search(rf"\b{stage};dur=[\d.]+", headers["server-timing"]), f"no {stage} in {headers['server-timing']}")
    link = re.search(r'<([^>]+)>; *rel="?describedby"?', headers["link"]).group(1)
    status, _, report = curl(base + link if link.startswith("/") else link)
    must(status == 200, f"{link}: status {status}")
    report = json.loads(report)
    must(
        report["input"]["instances"] == report["output"]["instances"],
        f"{report['input']['instances']} instances became {report['output']['instances']}",
    )
    must(report["output"]["meshes"] <= report["input"]["meshes"], "there are more unique meshes than before")
    print(f"{file}: {before} -> {after} triangles, {sent} -> {len(body)} bytes, {headers['server-timing']}")
    return report, body


def main(base, scene):
    report, body = optimize(base, scene, "model/gltf-binary", 0.5)
    must(report["output"]["instances"] == 13, f"{report['output']['instances']} instances in a scene of 13")
    must(body[:4] == b"glTF", f"not a GLB: {body[:4]!r}")

    with tempfile.NamedTemporaryFile("w", suffix=".iobj") as file:
        file.write(bumpy_grid(20, 4))
        file.flush()
        report, body = optimize(base, file.name, "model/vnd.coppice.iobj", 0.5)
    must(report["output"]["instances"] == 4, f"{report['output']['instances']} instances in a scene of 4")
    text = body.decode()
    must(text.startswith("#@iobj 1.0\n"), f"not an instanced OBJ: {text[:80]!r}")
    must(len(re.findall(r"(?m)^#@instance ", text)) == 4, "the answer has not the 4 instances of the upload")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
