"""Writes the licences of all crates that the program contains, with their texts, to standard output."""

import json
import pathlib
import subprocess

command = ["cargo", "metadata", "--format-version", "1", "--locked"]
metadata = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
packages = {package["id"]: package for package in metadata["packages"]}
nodes = {node["id"]: node for node in metadata["resolve"]["nodes"]}
program = next(id for id, package in packages.items() if package["name"] == "stickslip")

# What is linked: no build scripts' and no tests' dependencies.
linked, waiting = set(), [program]
while waiting:
    id = waiting.pop()
    if id not in linked:
        linked.add(id)
        normal = [one for one in nodes[id]["deps"] if any(kind["kind"] is None for kind in one["dep_kinds"])]
        waiting += [one["pkg"] for one in normal]

texts = {}
for package in sorted((packages[id] for id in linked), key=lambda package: (package["name"], package["version"])):
    if package["source"] is None:
        continue
    print(f"{package['name']} {package['version']}: {package['license']}")
    folder = pathlib.Path(package["manifest_path"]).parent
    for file in sorted(folder.iterdir()):
        if file.is_file() and file.name.upper().startswith(("LICENSE", "LICENCE", "COPYING", "NOTICE", "UNLICENSE")):
            texts.setdefault(file.read_text(errors="replace").strip(), []).append(f"{package['name']} ({file.name})")
for text, users in texts.items():
    print("\n" + "-" * 80 + "\n" + ", ".join(users) + "\n\n" + text)
