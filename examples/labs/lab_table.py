#!/usr/bin/env python3
"""Writes the labs' table in C: what program/lab.h declares, from each lab's lab.json (program/lab_read.c reads others).

usage: lab_table.py LAB.JSON... > lab_table.c
"""
import json
import os
import sys

# As enumerations in scene/scene.h and program/lab.h name them.
KINDS = {"directional": "LIGHT_DIRECTIONAL", "point": "LIGHT_POINT", "spot": "LIGHT_SPOT"}
REFLECTIONS = {"Phong": "REFLECTION_PHONG", "Blinn-Phong": "REFLECTION_BLINN_PHONG"}
SPECIAL = {"matrices": "given", "budget": "budget", "shadow map": "shadow"}


def put(value):
    if isinstance(value, bool):
        return "true"
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, list):
        return "{" + ", ".join(map(put, value)) + "}"
    return repr(value)


def members(values):
    return ", ".join(f".{name} = {value}" for name, value in values.items())


def scene(of):
    values = {name: put(value) for name, value in of.items() if name not in ("shape", "lights", "spot")}
    values["shape"] = "SHAPE_OF_" + of["shape"].upper().replace(" ", "_")
    values["lights"] = "{" + ", ".join("{%s, %s}" % (put(light["place"]), put(light["color"])) for light in of["lights"]) + "}"
    values.update({name: put(value) for name, value in of.get("spot", {}).items()})
    return "{" + members(values) + "}"


def lab(path):
    with open(path) as file:
        of = json.load(file)
    name = os.path.basename(os.path.dirname(os.path.abspath(path)))
    values = {"name": put(name), "file": put(name.split("_")[0]), "lights": str(len(of["scene"]["lights"])),
              "points": "LAB_POINTS"}
    for key, value in of.items():
        if key == "light":
            values[key] = KINDS[value]
        elif key == "highlight":
            values.update(specular="true", reflection=REFLECTIONS[value])
        elif key == "special":
            values[SPECIAL[value]] = "true"
        else:
            values[key] = scene(value) if key == "scene" else put(value)
    return "    {" + members(values) + "},\n"


if __name__ == "__main__":
    print('/* Written by lab_table.py. */\n#include "labs/program/lab.h"\n')
    print("const Lab LABS[LAB_COUNT] = {\n" + "".join(map(lab, sys.argv[1:])) + "};")
