#!/usr/bin/env python3
"""Scene: files of scenes, made here and Assimp's; the second reader is this file's own.

usage: scene_test.py EXAMPLES_FOLDER_OF_THE_BUILD SOURCE_FOLDER [unittest's arguments]
"""
import base64
import copy
import glob
import json
import math
import os
import random
import re
import resource
import struct
import sys
import unittest
import zlib

import command_line_test as base

MODELS = "/usr/share/assimp/models*"  # of Debian's assimp-testmodels
FORMATS = ("gltf", "glb", "dae", "zae", "fbx", "blend", "3ds", "obj", "ply", "stl", "x", "ase", "lwo", "off", "ac")
SEED = base.seed()

POSITIONS = (0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)
CORNERS = (0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3)
DATA = struct.pack("<12f12H", *POSITIONS, *CORNERS)


def tetrahedron(**members):
    """A file with one tetrahedron, node 0, and other members."""
    file = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0],
                       "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
        "buffers": [{"byteLength": len(DATA), "uri": data_uri(DATA)}]}
    file.update(members)
    return file


def data_uri(data):
    return "data:application/octet-stream;base64," + base64.b64encode(data).decode()


def glb(file, data=DATA):
    file = copy.deepcopy(file)
    file["buffers"] = [{"byteLength": len(data)}]
    text = json.dumps(file).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


# Matrices as rows.

def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def local(node):
    if "matrix" in node:
        return [[node["matrix"][4 * j + i] for j in range(4)] for i in range(4)]
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    turn = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0], [0, 0, 0, 1]]
    move, scale = node.get("translation", (0, 0, 0)), node.get("scale", (1, 1, 1))
    return [[turn[i][j] * (scale[j] if j < 3 else 1) + (move[i] if j == 3 and i < 3 else 0) for j in range(4)]
            for i in range(4)]


def apply(matrix, vector, w=1):
    return [sum(matrix[i][k] * (*vector, w)[k] for k in range(4)) for i in range(3)]


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def worlds(file):
    """Of each node that the scene has: its matrix."""
    found = {}

    def visit(number, parent):
        found[number] = product(parent, local(file["nodes"][number]))
        for child in file["nodes"][number].get("children", ()):
            visit(child, found[number])

    for root in file["scenes"][file.get("scene", 0)]["nodes"]:
        visit(root, local({}))
    return found


class Scene(base.Case):
    def save(self, name, file):
        self.make(name, file if isinstance(file, bytes) else json.dumps(file))
        return name

    def read_back(self, name, *options):
        """What --save-scene writes of a file: objects' matrices, lights and the camera in the world."""
        self.good(name, *options, "--save-scene", "back.gltf", program="Scene")
        file = json.loads(self.read("back.gltf"))
        lights = file["extensions"]["KHR_lights_punctual"]["lights"]
        return ([node["matrix"] for node in file["nodes"] if "mesh" in node],
                [light["extras"]["lighting"] for light in lights], file["cameras"][0]["extras"]["lighting"])

    def near(self, found, expected, places=9):
        for a, b in zip(found, expected, strict=True):
            self.assertAlmostEqual(a, b, places, (SEED, found, expected))

    def one_line(self, result, *what):
        text = result.stderr.decode()
        self.assertEqual((result.returncode, text.count("\n"), result.stdout), (1, 1, b""), (SEED, what, text))
        return text

    def random_file(self, chance):
        def node(**members):
            return {"translation": [chance.uniform(-3, 3) for _ in range(3)],
                    "rotation": unit([chance.uniform(-1, 1) for _ in range(4)]),
                    "scale": [chance.choice((-1, 1)) * chance.uniform(0.5, 2)] * 3, **members}

        nodes = [node(mesh=0, children=[1, 2]), node(children=[3, 4]), node(mesh=0, camera=0), node(mesh=0)]
        nodes += [node(extensions={"KHR_lights_punctual": {"light": i}}) for i in range(3)]
        nodes[3]["children"] = [5]
        kinds = ({"type": "point", "color": [1, 0.5, 0.25], "intensity": 10, "range": 7}, {"type": "directional"},
                 {"type": "spot", "intensity": 40, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.6}})
        return tetrahedron(nodes=nodes, scenes=[{"nodes": [0, 6]}], extensions={"KHR_lights_punctual": {"lights": kinds}},
                           cameras=[{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}, "name": "eye"}])

    def test_nodes_lights_and_cameras_are_where_a_second_reader_has_them(self):
        chance = random.Random(SEED)
        for _ in range(10 // base.step(3)):
            file = self.random_file(chance)
            found = worlds(file)
            objects, lights, camera = self.read_back(self.save("a.glb", glb(file)), "--exposure", str(math.pi))
            order = [0, 1, 3, 5, 4, 2, 6]  # depth first
            expected = [found[number] for number in order if "mesh" in file["nodes"][number]]
            for matrix, rows in zip(objects, expected, strict=True):
                self.near(matrix, [rows[i][j] for j in range(4) for i in range(4)])
            numbers = [number for number in order if "extensions" in file["nodes"][number]]
            for light, number in zip(lights, numbers, strict=True):
                index = file["nodes"][number]["extensions"]["KHR_lights_punctual"]["light"]
                self.assertEqual(light["kind"], (1, 0, 2)[index])
                if index != 1:
                    self.near(light["position"], apply(found[number], (0, 0, 0)))
                if index != 0:
                    self.near(light["direction"], unit(apply(found[number], (0, 0, 1 if index == 1 else -1), 0)))
            near = {light["kind"]: light for light in lights}
            self.near(near[1]["diffuse"], (10, 5, 2.5))
            self.assertAlmostEqual(near[2]["cutoff"], math.degrees(0.6))
            self.assertEqual((near[1]["range"], near[2]["range"]), (7, 0))
            self.assertEqual((near[1]["constant"], near[1]["linear"], near[1]["quadratic"]), (0, 0, 1))
            eye = apply(found[2], (0, 0, 0))
            self.near(camera["eye"], eye)
            self.near(unit([c - e for c, e in zip(camera["center"], eye)]), unit(apply(found[2], (0, 0, -1), 0)), 6)
            self.near(camera["up"], unit(apply(found[2], (0, 1, 0), 0)))
            self.assertAlmostEqual(camera["fovy"], math.degrees(0.7))

    def test_animations_move_nodes(self):
        times, places = struct.pack("<3f", 0, 1, 3), struct.pack("<9f", 0, 0, 0, 2, 0, 0, 2, 4, 0)
        turns = struct.pack("<12f", 0, 0, 0, 1, 0, 0, math.sin(math.pi / 4), math.cos(math.pi / 4), 0, 0, 1, 0)
        data = DATA + times + places + turns
        file = tetrahedron()
        file["accessors"] += [{"bufferView": 2, "componentType": 5126, "count": 3, "type": "SCALAR"},
                              {"bufferView": 3, "componentType": 5126, "count": 3, "type": "VEC3"},
                              {"bufferView": 4, "componentType": 5126, "count": 3, "type": "VEC4"}]
        file["bufferViews"] += [{"buffer": 0, "byteOffset": 72, "byteLength": 12},
                                {"buffer": 0, "byteOffset": 84, "byteLength": 36},
                                {"buffer": 0, "byteOffset": 120, "byteLength": 48}]
        file["animations"] = [{"samplers": [{"input": 2, "output": 3}, {"input": 2, "output": 4},
                                            {"input": 2, "output": 3, "interpolation": "STEP"}],
                               "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}},
                                            {"sampler": 1, "target": {"node": 0, "path": "rotation"}}]}]
        self.save("a.glb", glb(file, data))
        for time, place, angle in ((0, (0, 0, 0), 0), (0.5, (1, 0, 0), 45), (1, (2, 0, 0), 90), (2, (2, 2, 0), 135),
                                   (3.5, (1, 0, 0), 45)):
            matrix = self.read_back("a.glb", "--time", str(time))[0][0]
            self.near(matrix[12:15], place, 6)
            self.near(matrix[:2], (math.cos(math.radians(angle)), math.sin(math.radians(angle))), 6)
        file["animations"][0]["channels"] = [{"sampler": 2, "target": {"node": 0, "path": "translation"}}]
        self.save("a.glb", glb(file, data))
        self.near(self.read_back("a.glb", "--time", "2.9")[0][0][12:15], (2, 0, 0))
        eyes = [self.read_back("a.glb", "--time", time)[2]["eye"] for time in ("0", "2.9")]  # of a camera that fits all times
        self.near(*eyes)

    @base.in_long_form
    def test_a_scene_that_was_saved_draws_the_same_picture(self):
        for program, *options in (("Materials", "--shape", "head"), ("SmoothFlat", "--linear-light"), ("FourLights",),
                                  ("FourLights", "--interpolation", "gouraud", "--shadows", "on")):
            arguments = (*options, "-t", "1.5", "-s", "200x200")
            self.good(*arguments, "--save-scene", "a.gltf", program=program)
            self.good("a.gltf", "--save-scene", "b.gltf", program="Scene")
            expected = self.drawn(*arguments, program=program).pixels
            for name in ("a.gltf", "b.gltf"):
                self.assertEqual(self.drawn(name, "-s", "200x200", program="Scene").pixels, expected, (program, name))

    def test_every_program_saves_what_it_draws_but_for_axes_marks_and_labels(self):
        """Of several views the first. Axes and the marks of lights have components of 0 and 255 alone; a label ends a view."""
        side, label, marks = 150, 130, 600  # 150x150: four marks of 10x10, and three axes
        views = {"ColoredLights": (1, 5), "LightTypes": (3, 2), "PhongBlinn": (3, 1), "TermsApart": (5, 2)}
        for program in base.SCENES[:: base.step(2)]:
            columns, rows = views.get(program, (1, 1))
            size = f"{columns * side}x{rows * side}"
            self.assertEqual(self.run_it("-t", "1.5", "-s", size, "--save-scene", "a.gltf", program=program).returncode, 0)
            own = self.drawn("-t", "1.5", "-s", size, program=program)
            back = self.drawn("a.gltf", "-s", f"{side}x{side}", program="Scene")
            places = ((x, y) for y in range(side if program not in views else label) for x in range(side))
            found = [own.at(*place) for place in places if own.at(*place) != back.at(*place)]
            self.assertLessEqual(len(found), marks, program)
            self.assertLessEqual({value for pixel in found for value in pixel}, {0, 255}, program)

    def test_cameras_by_number_and_name(self):
        file = tetrahedron(nodes=[{"mesh": 0}, {"camera": 0, "name": "left", "translation": [-1, 0, 9]},
                                  {"camera": 0, "name": "far", "translation": [0, 0, 30]}],
                           scenes=[{"nodes": [0, 1, 2]}],
                           cameras=[{"name": "lens", "type": "perspective", "perspective": {"yfov": 0.5, "znear": 1}}])
        self.save("a.gltf", file)
        for option, eye in (((), (-1, 0, 9)), (("--camera", "1"), (0, 0, 30)), (("--camera", "far"), (0, 0, 30)),
                            (("--camera", "lens"), (-1, 0, 9))):
            self.near(self.read_back("a.gltf", *option)[2]["eye"], eye)
        self.assertNotIn(self.read_back("a.gltf", "--camera", "fit")[2]["eye"][2], (9, 30))
        said = self.one_line(self.run_it("a.gltf", "--camera", "4", program="Scene"))
        self.assertIn("camera 4: there is none; the file has 0 lens at left, 1 lens at far, and fit", said)
        result = self.run_it(program="Scene")
        self.assertEqual(result.returncode, 2)
        self.assertEqual(self.run_it("a.gltf", "b.gltf", program="Scene").returncode, 2)

    def columns(self, name, *options):
        """From which to which column something is drawn, of 200; None: nowhere."""
        picture = self.drawn(name, "-s", "200x200", *options, program="Scene")
        found = [x for x in range(200) if any(picture.at(x, y) != picture.at(0, 0) for y in range(200))]
        return (found[0], found[-1]) if found else None

    def test_an_orthographic_view_has_the_same_size_from_anywhere(self):
        """A triangle from -0.5 to 0.5, of 2 in height; what is a unit nearer than another is by a 300th larger."""
        for away in 2, 50, 900:
            view = {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 1000}}
            nodes = [{"mesh": 0, "translation": [-0.5, -0.5, 0]}, {"camera": 0, "translation": [0, 0, away]}]
            self.save("a.gltf", tetrahedron(nodes=nodes, scenes=[{"nodes": [0, 1]}], cameras=[view]))
            first, last = self.columns("a.gltf")
            self.assertTrue(abs(first - 50) <= 1 and abs(last - 149) <= 1, (away, first, last))

    def test_what_moves_away_stays_seen(self):
        keys = struct.pack("<2f", 0, 1) + struct.pack("<6f", 0, 0, 0, 0, 0, -40)
        file = tetrahedron(nodes=[{"mesh": 0}, {"camera": 0, "translation": [0.3, 0.3, 5]}], scenes=[{"nodes": [0, 1]}],
                           cameras=[{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}])
        file["buffers"].append({"byteLength": len(keys), "uri": data_uri(keys)})
        file["bufferViews"].append({"buffer": 1, "byteLength": len(keys)})
        file["accessors"] += [{"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR"},
                              {"bufferView": 2, "byteOffset": 8, "componentType": 5126, "count": 2, "type": "VEC3"}]
        file["animations"] = [{"samplers": [{"input": 2, "output": 3}],
                               "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]
        self.save("a.gltf", file)
        for options in ("-t", "0.9"), ("-t", "0.9", "--camera", "fit"):
            self.assertIsNotNone(self.columns("a.gltf", *options), options)

    def test_an_orbit_does_not_cost_the_depth_behind(self):
        """Around the eye and behind it there are things, too."""
        nodes = [{"mesh": 0, "translation": place} for place in ([0, 0, -9], [-0.3, -0.3, -0.3], [0, 0, 9])]
        nodes.append({"camera": 0})
        lens = {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "zfar": 50}}
        self.save("a.gltf", tetrahedron(nodes=nodes, scenes=[{"nodes": [0, 1, 2, 3]}], cameras=[lens]))
        camera = self.read_back("a.gltf", "--orbit", "20,10")[2]
        self.assertGreaterEqual(camera["near"], camera["far"] / 1011, camera)  # with a margin of 1%

    def test_a_linked_folder_is_not_followed(self):
        self.make("real/a.bin", DATA)
        os.symlink(self.path("real"), self.path("linked"))
        for folder, code in ("real", 0), ("linked", 1):
            self.save("a.gltf", tetrahedron(buffers=[{"byteLength": len(DATA), "uri": f"{folder}/a.bin"}]))
            result = self.run_it("a.gltf", *base.SMALL, program="Scene")
            self.assertEqual(result.returncode, code, result)
        self.assertIn("is a link", self.one_line(result, folder))

    def test_of_several_views_the_first_is_saved_and_that_is_said(self):
        said = self.run_it("--save-scene", "a.gltf", program="LightTypes").stderr.decode()
        self.assertIn("a.gltf has the first of the 6 views", said)

    def test_what_is_not_drawn_is_counted(self):
        material = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "alphaMode": "BLEND",
                    "normalTexture": {"index": 0}}
        file = tetrahedron(materials=[material], nodes=[{"mesh": 0, "skin": 0}] * 30, scenes=[{"nodes": list(range(30))}])
        file["meshes"][0]["primitives"][0]["material"] = 0
        said = self.good(self.save("a.gltf", file), "--explain", program="Scene").decode()
        for text in ("30 of 30 objects, first object 0: 1 directional light", "of the file, 30 times: textures of all but", "texture 0: white, for it cannot be read: there is none",
                     "of the file, 30 times: transparency", "of the file, 30 times: skins",
                     "the file has no light: there is one at the viewer"):
            self.assertIn(text, said)

    def textured(self, uri, **image):
        """A file whose material has an image, of a base colour of 0.5 in green."""
        material = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 0.5, 1, 1],
                                             "metallicFactor": 0}}
        file = tetrahedron(materials=[material], textures=[{"source": 0}], images=[{"uri": uri} if uri else image])
        file["meshes"][0]["primitives"][0]["material"] = 0
        return file

    @base.in_long_form
    def test_a_texture_of_the_base_colour_is_its_mean(self):
        """Of light, not of bytes: black and white pixels are half as bright as white ones."""
        rows = 4 * (b"\0" + b"".join(bytes((255 * (x < 5), 255, 188)) for x in range(10)))

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 10, 4, 8, 2, 0, 0, 0)) +
               chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
        light = ((188 / 255 + 0.055) / 1.055) ** 2.4
        self.make("a b.png", png)
        for uri in "a%20b.png", data_uri(png):
            self.good(self.save("a.gltf", self.textured(uri)), "--save-scene", "back.gltf", program="Scene")
            node, = [node for node in json.loads(self.read("back.gltf"))["nodes"] if "mesh" in node]
            self.near(node["extras"]["lighting"]["front"]["diffuse"], (0.5, 0.5, light))
        chance = random.Random(SEED)
        damaged = bytearray(png)
        damaged[chance.randrange(40, len(png))] ^= 255
        for uri, what in ((data_uri(png[:50]), "damaged"), (data_uri(b"GIF89a"), "no PNG"), ("none.png", "No such file"),
                          ("../a b.png", "outside"), ("http://example.org/a.png", "refused"), (data_uri(bytes(damaged)), ""),
                          (None, "there is no image"), (data_uri(png.replace(b"IDAT", b"\xdf\xba\xff\xff")), "damaged: ")):
            said = self.good(self.save("a.gltf", self.textured(uri)), "--explain", program="Scene").decode()
            if what:
                self.assertRegex(said, f"texture 0: white, for it cannot be read: .*{what}")

    @base.in_long_form
    def test_lights_light_what_they_reach(self):
        """Balls in a row, a light with a range at each end, and none of what is left out is seen."""
        nodes = [{"mesh": 0, "translation": [i, 0, 0]} for i in range(40)]
        nodes += [{"translation": [i, 1, 1], "extensions": {"KHR_lights_punctual": {"light": 0}}} for i in (0, 39)]
        nodes.append({"translation": [20, 2, 0.5], "rotation": [-math.sqrt(0.5), 0, 0, math.sqrt(0.5)],
                      "extensions": {"KHR_lights_punctual": {"light": 1}}})
        nodes.append({"extensions": {"KHR_lights_punctual": {"light": 2}}})
        lights = [{"type": "point", "intensity": 9, "range": 5}, {"type": "spot", "intensity": 9},
                  {"type": "directional", "intensity": 3e-4}]
        material = {"pbrMetallicRoughness": {"metallicFactor": 0}}
        self.save("a.gltf", tetrahedron(nodes=nodes, scenes=[{"nodes": list(range(44))}], materials=[material],
                                        meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
                                        extensions={"KHR_lights_punctual": {"lights": lights}}))
        said = self.good("a.gltf", "--explain", program="Scene").decode()
        for light in (0, 1):
            self.assertRegex(said, rf"light {light}: 3[3-5] of 40 objects are beyond its range")
        self.assertRegex(said, r"light 2: 3\d of 40 objects are missed by its cone")
        self.assertRegex(said, r"light 3: 40 of 40 objects find it too faint: at most 0\.[1-5] steps\n")
        self.assertRegex(said, r"\d+ of 40 objects, first object \d+: no light")
        self.assertRegex(said, r"1 point light \(diffuse,\s+specular,\s+attenuation,\s+range\)")
        pictures = [self.drawn("a.gltf", "-s", "300x300", *full, program="Scene").pixels for full in ((), ("--full",))]
        self.assertLessEqual(max(abs(a - b) for a, b in zip(*pictures)), 1)  # another order of the sum
        self.assertGreater(max(pictures[0]), 100)
        said = self.good("a.gltf", "--error", "1", "--explain", "-s", "160x160", program="Scene").decode()
        self.assertLessEqual(float(re.search(r"error ([\d.]+)\s+of\s+1\s+allowed", said)[1]), 1)

    @staticmethod
    def lit_file(chance, objects=24, lights=8):
        """Objects anywhere, and lights of all kinds, among them faint ones and such that reach little."""
        def at(size):
            return [chance.uniform(-size, size) for _ in range(3)]

        def turned():
            return unit([chance.gauss(0, 1) for _ in range(4)])

        materials = [{"pbrMetallicRoughness": {"baseColorFactor": [*(chance.random() for _ in range(3)), 1],
                                               "metallicFactor": k % 2, "roughnessFactor": chance.uniform(0.2, 1)}} for k in range(4)]
        meshes = [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": k}]} for k in range(4)]
        nodes = [{"mesh": chance.randrange(4), "translation": at(5), "rotation": turned(),
                  "scale": [chance.uniform(0.5, 3) for _ in range(3)]} for _ in range(objects)]
        table = []
        for k in range(lights):
            kind, outer = chance.choice(("directional", "point", "spot")), chance.uniform(0.1, 1.5)
            light = {"type": kind, "color": [chance.random() for _ in range(3)], "intensity": 10 ** chance.uniform(-3, 1)}
            if kind != "directional" and chance.random() < 0.5:
                light["range"] = chance.uniform(1, 12)
            if kind == "spot":
                light["spot"] = {"outerConeAngle": outer, "innerConeAngle": outer * chance.choice((0, 0.5, 0.99))}
            table.append(light)
            nodes.append({"translation": at(8), "rotation": turned(), "extensions": {"KHR_lights_punctual": {"light": k}}})
        return tetrahedron(nodes=nodes, scenes=[{"nodes": list(range(len(nodes)))}], materials=materials, meshes=meshes,
                           extensions={"KHR_lights_punctual": {"lights": table}})

    @base.in_long_form
    def test_what_does_not_reach_is_not_seen(self):
        """A light that is left out changes no pixel by more than half a step: rounded to bytes, by one. Every second file lacks a
        face of each object. The others are closed, and a pixel or two at outlines show a back face, which is left out, too."""
        rules = set()
        cases = range(100)[::base.step(25)]
        for case in cases:
            file = self.lit_file(random.Random(SEED + case))
            is_open = case // base.step(25) % 2
            if is_open:
                file["accessors"][1]["count"] = 9
            self.save("a.gltf", file)
            arguments = ("a.gltf", "--exposure", "1", "-s", "160x160")
            some, every = (self.drawn(*arguments, *full, program="Scene").pixels for full in ((), ("--full",)))
            others = {i // 3 for i in range(len(some)) if abs(some[i] - every[i]) > 1}
            self.assertLessEqual(len(others), 0 if is_open else 4, (SEED + case, [(i % 160, i // 160) for i in others]))
            said = self.good(*arguments, "--explain", program="Scene").decode()
            rules.update(re.findall(r"beyond its range|its cone misses|too faint: at most 0\.[1-5] steps", said))
        if len(cases) > 1:  # else the one may lack them
            self.assertLessEqual({"beyond its range", "its cone misses"}, rules)

    @base.in_long_form
    def test_colours_at_vertices_are_diffuse_whatever_the_material(self):
        """A metal, with or without a word of it, looks as no metal does; an unlit one as one without a highlight."""
        pictures = {}
        for name, members in (("metal", {}), ("none", {"pbrMetallicRoughness": {"metallicFactor": 0}}),
                              ("unlit", {"extensions": {"KHR_materials_unlit": {}}}),
                              ("dull", {"extensions": {"KHR_materials_pbrSpecularGlossiness": {"specularFactor": [0, 0, 0]}}})):
            file = tetrahedron(materials=[members], nodes=[{"mesh": 0, "rotation": [0, 1, 0, 0]}])
            file["meshes"][0]["primitives"][0].update(material=0, attributes={"POSITION": 0, "COLOR_0": 2})
            file["accessors"].append({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"})
            self.save("a.gltf", file)
            pictures[name] = self.drawn("a.gltf", *base.SMALL, program="Scene").pixels
            said = self.good("a.gltf", "--explain", program="Scene").decode()
            self.assertEqual("1 times: metals with colours" in said, name == "metal")
            self.assertEqual("1 times: unlit materials with colours" in said, name == "unlit")
        self.assertEqual(pictures["metal"], pictures["none"])
        self.assertEqual(pictures["unlit"], pictures["dull"])
        self.assertNotEqual(pictures["dull"], pictures["none"])

    def hall(self, lamps, side=8, **members):
        """Tetrahedra in rows, lit by lamps of a table above them, one after the other."""
        nodes = [{"mesh": 0, "translation": [2 * (i % side), 0, 2 * (i // side)]} for i in range(side * side)]
        nodes += [{"translation": [2 * (i % side) + 0.7, 1.2, 2 * (i // side % side) + 0.6], "rotation": [-math.sqrt(0.5), 0, 0, math.sqrt(0.5)],
                   "extensions": {"KHR_lights_punctual": {"light": i}}} for i in range(len(lamps))]
        return self.save("a.gltf", tetrahedron(nodes=nodes, scenes=[{"nodes": [*range(len(nodes))]}],
                                               extensions={"KHR_lights_punctual": {"lights": lamps}}, **members))

    @base.in_long_form
    def test_each_object_has_the_lights_that_reach_it(self):
        """A hall with more lamps than a program has, of which few reach an object, and one with as many lamps at each; the exact
        picture has all of them."""
        chance = random.Random(SEED)
        lamps = [{"type": chance.choice(("point", "spot")), "intensity": chance.uniform(1, 4), "range": chance.uniform(1.5, 3),
                  "color": [chance.random() for _ in range(3)]} for _ in range(64)]
        name = self.hall(lamps)
        arguments = (name, "--exposure", "1", "-s", "100x100")
        said = self.run_it(*arguments, "--error", "1.1", "--verbose", program="Scene").stderr.decode()
        error = re.search(r"\(plain: ([0-9.]+)\)", said)
        self.assertLessEqual(float(error.group(1)), 1.1, SEED)  # half a step is left out, and half is rounded
        said = self.good(*arguments, "--explain", program="Scene").decode()
        self.assertRegex(said, r"of 64 lights and 64 objects, \d+ times: the object is beyond its range")
        self.assertIn("32 to 63: more", said)
        self.assertNotIn("left out\n", said)
        pictures = [self.drawn(*arguments, *option, program="Scene").pixels for option in ((), ("--full",))]
        self.assertLessEqual(sum(abs(a - b) > 1 for a, b in zip(*pictures)), 12, SEED)  # at outlines, backs of faces; see below
        self.good(*arguments[:3], "--save-scene", "b.gltf", program="Scene")
        self.assertEqual(self.drawn("b.gltf", "-s", "100x100", program="Scene").pixels, pictures[0])
        said = self.good(*arguments, "--shadows", "on", "--explain", program="Scene").decode()
        self.assertIn("lights 32 to 63: none, because of a scene's lights the first 32 cast them", said)

    def test_of_too_many_lights_at_one_object_the_brightest_are_drawn(self):
        name = self.hall([{"type": "point", "intensity": 1 + i % 2} for i in range(40)], side=1)
        said = self.good(name, "--explain", program="Scene").decode()
        self.assertIn("of 40 lights and 1 objects, 8 times: lights but the 32 brightest: left out", said)
        self.assertRegex(said, r"without lights \d.*: lights but the 32 brightest: left out")

    @base.in_long_form
    def test_of_many_lights_the_brightest_are_drawn(self):
        chance = random.Random(SEED)
        lights = [{"type": "point", "intensity": chance.choice((0, 1e-9))} for _ in range(60)]
        lights[chance.randrange(60)] = {"type": "point", "intensity": 5}
        pictures = []
        for kept in lights, [light for light in lights if light["intensity"] == 5]:
            nodes = [{"mesh": 0}] + [{"translation": [2, 2, 2], "extensions": {"KHR_lights_punctual": {"light": i}}}
                                     for i in range(len(kept))]
            self.save("a.gltf", tetrahedron(nodes=nodes, scenes=[{"nodes": [*range(len(nodes))]}],
                                            extensions={"KHR_lights_punctual": {"lights": kept}}))
            pictures.append(self.drawn("a.gltf", *base.SMALL, program="Scene").pixels)
        self.assertEqual(*pictures)
        self.assertGreater(max(pictures[0]), 100)

    @base.in_long_form
    def test_the_unit_of_length_does_not_matter(self):
        """In millimetres a lamp has a million times the candela; bytes may be rounded otherwise."""
        pictures = []
        for unit in 1, 1000, 1e6:
            nodes = [{"mesh": 0, "scale": [unit] * 3},
                     {"translation": [2 * unit] * 3, "extensions": {"KHR_lights_punctual": {"light": 0}}}]
            self.save("a.gltf", tetrahedron(nodes=nodes, scenes=[{"nodes": [0, 1]}], extensions={
                "KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 5 * unit ** 2}]}}))
            pictures.append(self.drawn("a.gltf", *base.SMALL, program="Scene").pixels)
        for picture in pictures[1:]:
            self.assertLessEqual(max(abs(a - b) for a, b in zip(pictures[0], picture, strict=True)), 1)

    @base.in_long_form
    def test_obj_may_have_a_mark_and_other_ends_of_lines(self):
        lines = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n"
        pictures = [self.drawn(self.save("a.obj", mark + lines.replace(b"\n", end)), *base.SMALL, program="Scene").pixels
                    for mark, end in ((b"", b"\n"), (b"\xef\xbb\xbf", b"\n"), (b"", b"\r\n"), (b"", b"\r"))]
        self.assertEqual(pictures, pictures[:1] * 4)

    @staticmethod
    def ply(form, rows, faces, number="float", strips=False):
        """Rows of a place and a color; in words, or in bytes of one order. Properties that nobody reads are in between."""
        types = {"float": "f", "double": "d", "short": "h"}
        element = "tristrips 1" if strips else f"face {len(faces)}"
        text = (f"ply\r\nformat {form} 1.0\ncomment nothing\nelement camera 1\nproperty {number} nx\nproperty list uchar short x\n"
                f"element vertex {len(rows)}\n" + "".join(f"property {number} {name}\n" for name in ("x", "weight", "y", "z")) +
                "".join(f"property uchar {name}\n" for name in ("red", "green", "diffuse_blue")) +
                f"element {element}\nproperty uchar flags\nproperty list int {'int' if strips else 'uint16'} vertex_index\nend_header\n").encode()
        lists = [[n for face in faces for n in (*face, -1)][:-1]] if strips else faces
        if form == "ascii":
            lines = ["7 2 1 2"] + [f"{x} 9 {y} {z} {r} {g} {b}" for x, y, z, r, g, b in rows] + [" ".join(map(str, (8, len(face), *face))) for face in lists]
            return text + "\n".join(lines).encode() + b"\n"
        order, letter = ">" if "big" in form else "<", types[number]
        return (text + struct.pack(f"{order}{letter}B2h", 7, 2, 1, 2) +
                b"".join(struct.pack(f"{order}4{letter}3B", x, 9, y, z, r, g, b) for x, y, z, r, g, b in rows) +
                b"".join(struct.pack(f"{order}Bi{len(face)}{'i' if strips else 'H'}", 8, len(face), *face) for face in lists))

    @base.in_long_form
    def test_ply_in_words_and_bytes(self):
        """Of the same mesh the same picture, which has its colours: a polygon with a notch, a quadrilateral and triangles, or strips."""
        rows = [(0, 0, 0, 255, 0, 0), (4, 0, 0, 0, 255, 0), (4, 4, 0, 0, 0, 255), (2, 1, 0, 255, 255, 0), (0, 4, 0, 0, 255, 255), (0, 0, -3, 255, 0, 255)]
        faces, triangles = [(0, 1, 2, 3, 4), (0, 4, 5), (0, 5, 1)], [(0, 1, 3), (1, 2, 3), (0, 3, 4), (0, 4, 5), (0, 5, 1)]
        forms = [self.ply(form, rows, faces, number) for form in ("ascii", "binary_little_endian", "binary_big_endian") for number in ("float", "double", "short")]
        forms += [self.ply(form, rows, triangles, strips=True) for form in ("ascii", "binary_little_endian")]
        pictures = [self.drawn(self.save("a.ply", form), *base.SMALL, program="Scene").pixels for form in forms]
        for number, picture in enumerate(pictures):
            self.assertEqual(picture, pictures[0], number)
        red = self.drawn(self.save("a.ply", self.ply("ascii", [(*row[:3], 255, 0, 0) for row in rows], faces)), *base.SMALL, program="Scene")
        size = len(red.pixels) // (red.width * red.height)
        self.assertGreater(max(red.pixels[::size]), 150)
        self.assertLessEqual(max(red.pixels[1::size]), 51) # the background

    @base.in_long_form
    def test_polygons_of_many_corners(self):
        """A star of 30,001 corners is cut in PLY as in OBJ."""
        count = 30001
        corners = [(math.cos(a) * r, math.sin(a) * r) for i in range(count) for a, r in ((2 * math.pi * i / count, 1 + i % 2),)]
        rows = [(x, y, 0, 255, 255, 255) for x, y in corners]
        picture = self.drawn(self.save("a.ply", self.ply("binary_little_endian", rows, [range(count)])), *base.SMALL, program="Scene")
        lines = "".join(f"v {x:.9g} {y:.9g} 0 1 1 1\n" for x, y in corners) + "mtllib a.mtl\nusemtl white\nf " + " ".join(map(str, range(1, count + 1)))
        self.save("a.mtl", b"newmtl white\nKd 1 1 1\n")
        self.assertEqual(picture.pixels, self.drawn(self.save("a.obj", lines.encode()), *base.SMALL, program="Scene").pixels)

    def bad_files(self):
        """Name, file, what its message says."""
        def changed(path, value):
            file = tetrahedron()
            *path, last = path
            item = file
            for key in path:
                item = item[key]
            item[last] = value
            return file

        huge = 10 ** 9
        yield "a.gltf", b"{", "line 1"
        yield "a.gltf", b"[]", "no object"
        yield "a.gltf", b'{"asset": {"version": "3.0"}}', "version 3.0"
        yield "a.gltf", b"\xff\xfe{}", "JSON"
        yield "a.gltf", b"[" * 100000, "JSON"
        yield "a.gltf", json.dumps(tetrahedron()).replace("[0, 0, 0]", "[0, 0, 1e999]").encode(), "JSON"
        yield "a.glb", b"glTF", "ends after"
        yield "a.glb", b"nothing of that kind", "does not begin"
        yield "a.glb", glb(tetrahedron())[:-30], "ends after"
        yield "a.glb", glb(tetrahedron())[:12] + struct.pack("<I", 1 << 31) + glb(tetrahedron())[16:], "first chunk"
        yield "a.gltf", changed(("nodes", 0), {"mesh": 0, "children": [0]}), "nodes 0: is reached twice"
        yield "a.gltf", changed(("nodes",), [{"children": [1]}, {"mesh": 0, "children": [0]}]), "is reached twice"
        yield "a.gltf", changed(("nodes", 0, "mesh"), huge), f"meshes {huge}: there is none; the file has 1"
        yield "a.gltf", changed(("nodes", 0, "matrix"), [0] * 16), "must be finite and affine"
        yield "a.gltf", changed(("scenes", 0, "nodes"), [7]), "nodes 7: there is none"
        yield "a.gltf", changed(("scene",), 3), "scenes 3: there is none"
        yield "a.gltf", changed(("accessors", 0, "count"), huge), f"count {huge}"
        yield "a.gltf", changed(("accessors", 0, "count"), 5), "leave its bufferView of 48 bytes"
        yield "a.gltf", changed(("accessors", 0, "byteOffset"), 1 << 40), "leave its bufferView"
        yield "a.gltf", changed(("accessors", 1, "componentType"), 5), "type is unknown"
        yield "a.gltf", changed(("bufferViews", 0, "byteLength"), huge), "leaves its buffer of 72"
        yield "a.gltf", changed(("bufferViews", 0, "byteStride"), 1 << 30), "leave"
        yield "a.gltf", changed(("buffers", 0, "byteLength"), huge), "byteLength 1000000000, but it has 72 bytes"
        for light, what in (({"type": "area"}, "lights 0: its type must be"), ({}, "lights 0: its type must be"),
                            ({"type": "spot", "spot": {"innerConeAngle": 1, "outerConeAngle": 0.5}}, "inner <= outer"),
                            ({"type": "spot", "spot": {"outerConeAngle": 2}}, "innerConeAngle 0 and outerConeAngle 2")):
            yield "a.gltf", tetrahedron(nodes=[{"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}],
                                        extensions={"KHR_lights_punctual": {"lights": [light]}}), what
        for uri, what in (("http://example.org/a.bin", "refused"), ("file:///etc/passwd", "refused"),
                          ("../a.bin", "outside"), ("/etc/passwd", "outside"), ("x/..%2f..%2fa.bin", "outside"),
                          ("%2e%2e/a.bin", "outside"), ("..\\a.bin", "outside"), ("none.bin", "No such file")):
            yield "a.gltf", changed(("buffers", 0, "uri"), uri), what
        nan = struct.pack("<12f12H", math.nan, *POSITIONS[1:], *CORNERS)
        yield "a.gltf", changed(("buffers", 0, "uri"), data_uri(nan)), "position (nan"
        far = struct.pack("<12f12H", *POSITIONS, 9, *CORNERS[1:])
        yield "a.glb", glb(tetrahedron(), far), "index 9; there are 4 vertices"
        flat = struct.pack("<12f12H", *(0,) * 12, *CORNERS)
        yield "a.glb", glb(tetrahedron(), flat), "no triangle with an area"
        for none in False, 3, None, -1:
            yield "a.gltf", tetrahedron(nodes=[{"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": none}}}]), "there is none"
        yield "a.gltf", tetrahedron(extensionsRequired=["KHR_draco_mesh_compression"]), "requires KHR_draco"
        packed = tetrahedron()
        packed["meshes"][0]["primitives"][0]["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": 0}}
        for accessor in packed["accessors"]:
            del accessor["bufferView"]
        yield "a.gltf", packed, "compressed by Draco"
        yield "a.gltf", changed(("meshes", 0, "primitives", 0, "mode"), 7), "mode is 7"
        yield "a.gltf", changed(("bufferViews", 0, "byteStride"), 4), "byteStride 4"
        yield "a.glb", glb(tetrahedron()).replace(b"glTF\2", b"glTF\3"), "version 3"
        yield "a.dae", b"<COLLADA>", "cannot read"
        plain = (b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                 b"property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        yield "a.ply", plain.replace(b"0 1 0", b"0 x 0"), "there is no number within vertex 3 of 3"
        yield "a.ply", plain[:-2], "the file ends within face 1 of 1"
        yield "a.ply", plain.replace(b"float x", b"real x"), "line 4: property real x"
        yield "a.ply", plain.replace(b"face 1", b"face 0"), "no faces"
        yield "a.ply", plain.replace(b"end_header", b""), "no end"
        yield "a.obj", b"mtllib ../../../etc/passwd\n", "cannot read"

    @base.in_long_form
    @unittest.skipIf(base.SANITIZED, "a sanitizer has a heap of its own")
    def test_frames_of_large_meshes_take_no_new_memory(self):
        """What Mesa takes for the vertices of a frame is not given back to the system, which clears it."""
        side = 200
        places = struct.pack(f"<{3 * side * side}f", *(x for i in range(side * side) for x in (i % side, i // side, i * i % 7)))
        corners = [i + k for i in range(side * (side - 1)) if i % side < side - 1 for k in (0, 1, side, side, 1, side + 1)]
        data = places + struct.pack(f"<{len(corners)}I", *corners)
        file = tetrahedron()
        file["accessors"][0].update(count=side * side)
        file["accessors"][1].update(count=len(corners), componentType=5125)
        file["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 0
        file["bufferViews"] = [{"buffer": 0, "byteLength": len(places)},
                               {"buffer": 0, "byteOffset": len(places), "byteLength": 4 * len(corners)}]
        self.save("a.glb", glb(file, data))
        faults = []
        for count in 1, 11:
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_minflt
            self.good("a.glb", *base.SMALL, "-n", str(count), "-o", "%d.ppm", program="Scene")
            faults.append(resource.getrusage(resource.RUSAGE_CHILDREN).ru_minflt - before)
        self.assertLess(faults[1] - faults[0], 1000, faults)

    def test_bad_files_end_with_one_line(self):
        for name, file, what in list(self.bad_files())[:: base.step(4)]:
            self.save(name, file)
            said = self.one_line(self.run_it(name, *base.SMALL, program="Scene"), file, what)
            self.assertTrue(said.startswith(f"Scene: {name}: ") and what in said, (what, said))

    def test_damaged_files_are_drawn_or_refused(self):
        chance = random.Random(SEED)
        whole = glb(self.random_file(chance))
        for _ in range(400 // base.step(40)):
            data = bytearray(whole[:chance.choice((len(whole), chance.randrange(len(whole))))])
            for _ in range(chance.randrange(4)):
                data[chance.randrange(len(data))] = chance.randrange(256)
            self.save("a.glb", bytes(data) or b"x")
            result = self.run_it("a.glb", *base.SMALL, program="Scene")
            if result.returncode:
                self.one_line(result, bytes(data))

    def test_files_of_assimp_draw_or_end_with_one_line(self):
        paths = sorted(path for path in glob.glob(MODELS + "/**", recursive=True)
                       if path.rpartition(".")[2].lower() in FORMATS)
        if not paths:
            self.skipTest("no models; apt-get install assimp-testmodels")
        drawn = 0
        paths = paths[SEED % base.step(12)::base.step(12)]
        for path in paths:
            result = self.run_it(path, *base.SMALL, program="Scene")
            if result.returncode:
                self.one_line(result, path)
            drawn += result.returncode == 0
        self.assertGreater(drawn, len(paths) / 2)

    def test_lights_of_fbx_are_as_bright_as_they_are_meant(self):
        """Their decay starts at a distance, where they are not brighter than near by; of 1000 watts they are dimmed."""
        for path in glob.glob(f"{MODELS}/FBX/spider.fbx") + glob.glob(f"{MODELS}/FBX/animation_with_skeleton.fbx"):
            pixels = self.drawn(path, "--camera", "fit", *base.SMALL, program="Scene").pixels
            self.assertLess(sum(value == 255 for value in pixels) / len(pixels), 0.02, path)
            said = self.good(path, "--explain", program="Scene").decode()
            self.assertIn("M scales evenly" if "spider" in path else "of the file: how bright", said)

    @base.in_long_form
    def test_lights_that_are_amplified_near_by_are_dimmed(self):
        """An attenuation far below 1 means a strong lamp, whose distance the file's author knows."""
        pictures = []
        for quadratic in 0.05, 0.0005, 0.00005:
            places = " ".join(map(str, POSITIONS))
            self.save("a.dae", f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset/>
<library_lights><light id="l"><technique_common><point><color>1 1 1</color><constant_attenuation>0</constant_attenuation>
<quadratic_attenuation>{quadratic}</quadratic_attenuation></point></technique_common></light></library_lights>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="12">{places}</float_array><technique_common>
<accessor source="#a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>{" ".join(map(str, CORNERS))}</p></triangles></mesh>
</geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node>
<node><translate>3 3 3</translate><instance_light url="#l"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>""".encode())
            pictures.append(self.drawn("a.dae", *base.SMALL, program="Scene").pixels)
        for picture in pictures:
            self.assertTrue(any(picture))
            self.assertLess(sum(value == 255 for value in picture) / len(picture), 0.02)

    def test_the_exact_picture_agrees(self):
        paths = [path for name in ("Collada/duck.dae", "OBJ/spider.obj", "glTF2/ClearCoat-glTF/ClearCoatTest.gltf",
                                   "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", "3DS/fels.3ds")
                 for path in glob.glob(f"{MODELS}/{name}")]
        paths.append(self.path(self.save("own.glb", glb(self.random_file(random.Random(1))))))
        for path in paths[::-base.step(2)]:
            said = self.good(path, "--camera", "fit", "--error", "1", "--explain", "-s", "160x160", program="Scene").decode()
            # Half a step is rounding to bytes.
            error = float(re.search(r"error ([\d.]+)\s+of\s+1\s+allowed", said)[1])
            self.assertLessEqual(error, 1, path)


if __name__ == "__main__":
    sys.exit(base.main())
