"""Models and scenes in a page: the same pictures, words and exact bits as natively, and bad files are one line."""
import base64
import glob
import json
import os
import pathlib
import re
import struct
import subprocess
import tempfile

from pages import EXAMPLES, PAGE_NATIVE, Case
from pixel_pages import Pixels

MODELS = "/usr/share/assimp/models*"  # of Debian's assimp-testmodels
DROP = """(() => {
    const transfer = new DataTransfer();
    for (const [name, text] of %s)
        transfer.items.add(new File([Uint8Array.from(atob(text), letter => letter.charCodeAt(0))], name));
    document.getElementById("error").textContent = document.getElementById("files-said").textContent = "";
    window.dispatchEvent(new DragEvent("drop", {dataTransfer: transfer, bubbles: true, cancelable: true}));
})()"""
SAID = "document.getElementById('error').textContent || /is drawn/.test(document.getElementById('files-said').textContent)"
# A roof of a square and an arrowhead that is not convex, in two materials, one with a texture; a corner's normal.
OBJ = b"""mtllib roof.mtl
v -1 0 -1
v 1 0 -1
v 1 0 1 1 0.5 0
v -1 0 1
v 0 1.5 -1
v 0 1 0
v 0 1.5 1
vn 0 1 0.2
usemtl red
f 1/1/1 2//1 3 \\
4
usemtl picture
o side
f -6 -3 -2 -1 -5
"""
MTL = b"""newmtl red
Kd 0.8 0.1 0.1
Ks 0.5 0.5 0.5
Ns 20
newmtl picture
Kd 1 0.8
map_Kd -s 1 1 1 dot.bmp
"""
BMP = (struct.pack("<2sIII", b"BM", 70, 0, 54) + struct.pack("<IiiHHIIiiII", 40, 2, 2, 1, 24, 0, 16, 0, 0, 0, 0) +
       bytes((200, 0, 30, 90, 90, 90, 0, 0, 255, 250, 1, 1, 7, 40, 0, 0)))


class OfModels(Case):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        before = os.getcwd()
        os.chdir(folder.name)
        self.addCleanup(os.chdir, before)

    def drop(self, *names):
        """Files of this folder, onto the page; what it says of them."""
        files = [[name, base64.b64encode(pathlib.Path(name).read_bytes()).decode()] for name in names]
        self.page.run(DROP % json.dumps(files))
        self.page.wait(SAID)
        self.settle()
        return self.text("#error")

    def scene(self, name, program, *arguments):
        """A file of one of our scenes."""
        subprocess.run([os.path.join(EXAMPLES, program), *arguments, "--save-scene", name, "-o", "picture.png"], check=True)
        return name

    def moving(self):
        """A scene with a light, two cameras, one of them on a node that an animation moves, and data in a file of its own."""
        corners = struct.pack("<12f12H", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3)
        pathlib.Path("data of it.bin").write_bytes(corners + struct.pack("<2f6f", 0, 2, 0, 0, 3, 1, 0.5, 3))
        numbers = [(0, 4, "VEC3", 5126, 48), (48, 12, "SCALAR", 5123, 24), (72, 2, "SCALAR", 5126, 8), (80, 2, "VEC3", 5126, 24)]
        camera = {"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.1}}
        pathlib.Path("moving.gltf").write_text(json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1, 2, 3]}],
            "nodes": [{"mesh": 0}, {"translation": [0, 0, 3], "camera": 0, "name": "rail"},
                      {"translation": [0.3, 0.3, 4], "camera": 1},
                      {"translation": [2, 1, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], "cameras": [camera, {**camera, "name": "b"}],
            "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 30, "color": [1, 0.8, 0.5]}]}},
            "accessors": [{"bufferView": i, "count": count, "type": kind, "componentType": component}
                          for i, (_, count, kind, component, _) in enumerate(numbers)],
            "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, _, _, _, size in numbers],
            "buffers": [{"uri": "data%20of%20it.bin", "byteLength": 104}],
            "animations": [{"samplers": [{"input": 2, "output": 3}],
                            "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]}]}))
        return "moving.gltf", "data of it.bin"

    def roof(self):
        for name, data in (("roof.obj", OBJ), ("roof.mtl", MTL), ("dot.bmp", BMP)):
            pathlib.Path(name).write_bytes(data)
        return "roof.obj", "roof.mtl", "dot.bmp"

    def set(self, option, value):
        """By its control; one change."""
        self.page.run(f"Page.start(new Map([...Page.page.values, [{json.dumps(option)}, {json.dumps(value)}]]))")

    def assert_drawn(self, page, files, options):
        """The files' scene is drawn as natively with each of the options."""
        self.open(page)
        self.assertEqual(self.drop(*files), "")
        self.assert_native()
        for option in options:
            with self.subTest(page, files=files, option=option):
                self.set(*option.split("="))
                self.assertEqual(self.text("#error"), "")
                self.assert_native()
        self.assertEqual(self.page.complaints(), [])


class Models(OfModels):
    def test_they_draw_what_they_draw_natively(self):
        self.assert_drawn("Scene", self.moving(), ("time=1.3", "camera=b", "camera=fit", "shadows=on", "exposure=0.3"))
        self.assert_drawn("Scene", self.roof(), ("interpolation=flat", "up=z", "samples=4"))
        self.assert_drawn("Scene", [self.scene("four.gltf", "FourLights")], ("time=2", "precision=mediump"))
        for path in glob.glob(f"{MODELS}/glTF2/BoxTextured-glTF-Binary/*.glb") + glob.glob(f"{MODELS}/OBJ/spider.obj"):
            pathlib.Path(os.path.basename(path)).write_bytes(pathlib.Path(path).read_bytes())
            self.assert_drawn("Scene", [os.path.basename(path)], ("time=1",))
        for page in ("ShadingModels", "SpotLight", "Materials", "TermsApart"):
            self.assert_drawn(page, self.roof(), ("up=z",))

    def test_words_bits_and_pixels_are_those_of_the_command(self):
        self.open("Scene")
        self.assertEqual(self.drop(*self.moving()), "")
        said = subprocess.run([os.path.join(EXAMPLES, "Scene"), "moving.gltf", "--explain", "-o", "picture.png"], check=True,
                              capture_output=True, text=True).stdout
        self.page.run("document.getElementById('explain').open = true")
        self.settle()
        untimed = [re.sub("linked in .* ms", "", text.strip()) for text in (self.text("#explained"), said)]
        self.assertEqual(*untimed)
        answer = subprocess.run([PAGE_NATIVE], input="Scene --file=moving.gltf --size=90x60\n", capture_output=True, text=True,
                                check=True).stdout
        result = self.page.run("""ErrorWorker.compute({compiled: Page.page.compiled, texts: new Map(), seconds: 0, orbit: [0, 0, 1],
            lines: ["Scene", "--file=moving.gltf", "--size=90x60"]}).then(r => r.error || r)""")
        self.assertEqual(result, json.loads(answer))
        told = subprocess.run([os.path.join(EXAMPLES, "Scene"), "moving.gltf", "--probe", "200,220", "--format", "json"], check=True,
                              capture_output=True).stdout
        x, y = Pixels.at(self, (200, 220))
        self.page.mouse("mousePressed", x, y)
        self.page.mouse("mouseReleased", x, y)
        self.page.wait("document.getElementById('pixel') && document.getElementById('pixel').dataset.milliseconds")
        self.assertEqual(self.page.run("Pixel.said()"), json.loads(told))
        self.assertEqual(self.page.complaints(), [])

    def test_texts_options_and_camera_stay(self):
        self.open("ShadingModels", "interpolation=gouraud&orbit=30,20")
        self.edit("void main", "void /* own */ main")
        self.page.wait("document.querySelector('.said').textContent.startsWith('Drawn with')")
        self.assertEqual(self.drop(*self.roof()), "")
        command = self.text("#command")
        for words in ("--model roof.obj", "--interpolation gouraud", "--orbit 30,20", "--shaders mine"):
            self.assertIn(words, command)
        self.assertNotIn("roof", self.page.run("location.hash"))
        self.page.click("#default")
        self.assertIn("--model roof.obj", self.text("#command"))

    def test_bad_files_are_one_line(self):
        whole = self.scene("four.gltf", "FourLights")
        self.open("Scene")
        self.roof()
        text = pathlib.Path(whole).read_text()
        bad = {"cut.gltf": text[:len(text) // 2], "none.glb": "glTF", "words.gltf": "[]", "empty.obj": "", "face.obj": "v 0 0 0\nf 1 2 3\n",
               "a.fbx": "x", "nan.obj": "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "net.gltf": text.replace("data:application", "http:application"),
               "three.obj": "v 1 2\n", "lines.obj": "v 1 2 3\nl 1 1\n"}
        for name, data in bad.items():
            pathlib.Path(name).write_text(data)
            with self.subTest(name):
                said = self.drop(name)
                self.assertTrue(said.startswith(name + ": ") and "\n" not in said, said)
                if name != "a.fbx":
                    done = subprocess.run([os.path.join(EXAMPLES, "Scene"), name], capture_output=True, text=True, check=False)
                    self.assertEqual(done.returncode, 1)
                    if name not in ("cut.gltf",):  # the words are the browser's
                        self.assertEqual("Scene: " + said + "\n", done.stderr)
        # One that is not read in time, as if none was left, while it is.
        count = 200000
        pathlib.Path("long.obj").write_text("".join(f"v {i % 7} {i % 5} 0\n" for i in range(count)) + "f " +
                                            " ".join(str(i + 1) for i in range(count)) + "\n")
        self.page.run("window.later = setTimeout; window.setTimeout = (what, when) => later(what, when < 10000 ? when : 0)")
        self.assertRegex(self.drop("long.obj"), "long.obj: cannot read: it takes too much time or memory; is it damaged")
        self.page.run("window.setTimeout = later")
        self.assertEqual(self.drop(whole), "")
        self.assert_native()
        # One that is bad leaves what is drawn.
        self.assertIn("cannot read", self.drop("words.gltf"))
        self.assertIn("no triangle", self.drop("lines.obj"))
        self.set("time", "1")
        self.assert_native()
        self.assertEqual(self.page.complaints(), [])
