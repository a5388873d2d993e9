#!/usr/bin/env python3
"""What scenes of files cost in processor time: frames by objects, by lights that reach them and by pixels, and the first picture of
a million triangles. Prints the tables of examples/guide/scenes.md, and plots the first with gnuplot.

usage: scene_cost.py EXAMPLES_FOLDER_OF_THE_BUILD PLOT.png
"""
import array
import json
import math
import os
import resource
import struct
import subprocess
import sys
import tempfile
import time

FRAMES, ROUNDS = 20, 3
OBJECTS, REACH, SIDES = (100, 200, 400, 800, 1600, 3200), (0, 1, 2, 4, 8), (200, 283, 400, 566, 800)


def glb(path, data, views, **members):
    text = json.dumps({"asset": {"version": "2.0"}, "buffers": [{"byteLength": len(data)}], "bufferViews": views, **members}).encode()
    text += b" " * (-len(text) % 4)
    data += bytes(-len(data) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


def ball(columns, rows):
    """Positions, which are normals, too; corners. It is closed: what coincides at its seam and its poles is equal."""
    places, corners = array.array("f"), array.array("I")
    for j in range(rows + 1):
        height, radius = math.cos(math.pi * j / rows), math.sin(math.pi * (j % rows) / rows)
        for i in range(columns + 1):
            angle = 2 * math.pi * (i % columns) / columns
            places.extend((radius * math.sin(angle), height, radius * math.cos(angle)))
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b = a + columns + 1
            corners.extend((a, b, a + 1) if j else ())
            corners.extend((a + 1, b, b + 1) if j < rows - 1 else ())
    return places, corners


def write_balls(path, mesh, objects, lights, reach):
    """Balls in a square, and lights of which some reach them all, the others none."""
    places, corners = mesh
    side = math.ceil(math.sqrt(objects))
    nodes = [{"mesh": 0, "translation": [2.5 * (i % side), 0, 2.5 * (i // side)]} for i in range(objects)]
    nodes += [{"translation": [2 * k, 3 if k < reach else 99999, k], "extensions": {"KHR_lights_punctual": {"light": int(k >= reach)}}}
              for k in range(lights)]
    counts = [(len(places) // 3, "VEC3", 5126, places), (len(corners), "SCALAR", 5125, corners)]
    views, data = [], b""
    for _, _, _, numbers in counts:
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": 4 * len(numbers)})
        data += numbers.tobytes()
    point = {"type": "point", "intensity": 5}
    glb(path, data, views, scenes=[{"nodes": list(range(len(nodes)))}], nodes=nodes,
        accessors=[{"bufferView": i, "count": count, "type": kind, "componentType": component}
                   for i, (count, kind, component, _) in enumerate(counts)],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1, "material": 0}]}],
        materials=[{"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.5}}],
        extensions={"KHR_lights_punctual": {"lights": [point, {**point, "range": 0.01}]}})


def write_texts(mesh):
    """The same ball as PLY and OBJ, without normals."""
    places, corners = mesh
    with open("ball.ply", "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
                   b"element face %d\nproperty list uchar int vertex_indices\nend_header\n" % (len(places) // 3, len(corners) // 3))
        file.write(places.tobytes())
        file.write(b"".join(struct.pack("<B3I", 3, *corners[i:i + 3]) for i in range(0, len(corners), 3)))
    with open("ball.obj", "w", encoding="ascii") as file:
        file.writelines("v %.6f %.6f %.6f\n" % tuple(places[i:i + 3]) for i in range(0, len(places), 3))
        file.writelines("f %d %d %d\n" % tuple(n + 1 for n in corners[i:i + 3]) for i in range(0, len(corners), 3))


def seconds(*arguments):
    """Of a process and its children: processor time, and by the clock."""
    def used():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    before, start = used(), time.monotonic()
    subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return used() - before, time.monotonic() - start


def median(values):
    return sorted(values)[len(values) // 2]


def frame(scene, side=400):
    """Milliseconds of a frame that is drawn, read back and written."""
    def run(count):
        return seconds(scene, "balls.glb", "--exposure", "1", "-n", str(count), "-s", f"{side}x{side}", "-o", "f%02d.ppm")[0]

    return 1000 * median([(run(FRAMES + 1) - run(1)) / FRAMES for _ in range(ROUNDS)])


def main():
    examples, plot = (os.path.abspath(path) for path in sys.argv[1:3])
    scene, small, large = os.path.join(examples, "Scene"), ball(16, 9), ball(1000, 501)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        series = {"objects": [], "lights that reach them": [], "pixels": []}
        for objects in OBJECTS:
            write_balls("balls.glb", small, objects, 2, 2)
            series["objects"].append((objects, frame(scene)))
        for reach in REACH:
            write_balls("balls.glb", small, 400, 8, reach)
            series["lights that reach them"].append((reach, frame(scene)))
        write_balls("balls.glb", small, 400, 2, 2)
        for side in SIDES:
            series["pixels"].append((side * side, frame(scene, side)))
        print("| a frame of balls of 256 triangles, by | ms of processor time |\n|---|---|")
        for name, rows in series.items():
            print(f"| {name} | " + ", ".join(f"{x}: {y:.1f}" for x, y in rows) + " |")
        print("\n| a million triangles | MB | processor time, s |\n|---|---|---|")
        write_balls("ball.glb", large, 1, 0, 0)
        write_texts(large)
        for name in ("ball.ply", "ball.obj", "ball.glb"):
            times = [seconds(os.path.join(examples, "ShadingModels"), "--model", name, "-o", "x.png")[0] for _ in range(ROUNDS)]
            print(f"| `ShadingModels --model {name}` | {os.path.getsize(name) / 1e6:.0f} | {median(times):.2f} |")
        exact = seconds(scene, "ball.glb", "--error", "255", "-s", "400x400", "-o", "x.png")[0]
        print(f"| its exact picture of 400x400, `Scene ball.glb --error 255` | | {exact:.1f} |")
        text = "set terminal pngcairo size 960,320 font 'DejaVu Sans,9'\nset output '%s'\nset multiplot layout 1,3\nset key off\n" % plot
        text += "set yrange [0:*]\nset ylabel 'ms a frame'\nset xtics 0,1\nset style line 1 lc rgb '#2060c0' pt 7 lw 1.5\n"
        for number, (name, rows) in enumerate(series.items()):
            with open(f"{number}.txt", "w", encoding="ascii") as file:
                file.writelines(f"{x} {y}\n" for x, y in rows)
            step = {"objects": 1000, "pixels": 200000}.get(name, 2)
            text += f"set xlabel '{name}'\nset xtics 0,{step}\nset xrange [0:{max(x for x, _ in rows)}]\nfit a{number} + b{number} * x '{number}.txt' via a{number}, b{number}\n"
            text += f"plot '{number}.txt' with points ls 1, a{number} + b{number} * x lc rgb '#909090'\n"
        subprocess.run(["gnuplot"], input=text + "unset multiplot\n", text=True, check=True, stderr=subprocess.DEVNULL)


main()
