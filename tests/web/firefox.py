"""Drives Firefox on a display of its own through WebDriver BiDi (https://w3c.github.io/webdriver-bidi). Headless it has no
WebGL (https://bugzilla.mozilla.org/show_bug.cgi?id=1375585)."""
import base64
import json
import os
import pathlib
import shutil
import socket
import struct
import subprocess
import tempfile
import time

from browser import PATIENCE, Failed, Page

# Else there is no WebGL by a software renderer, and no more of its name than "llvmpipe, or similar".
PREFERENCES = {"webgl.force-enabled": True, "webgl.sanitize-unmasked-renderer": False}


def missing():
    """Which of the programs that it needs is not there, or None."""
    return next((tool for tool in ("firefox-esr", "Xvfb") if not shutil.which(tool)), None)


class WebSocket:
    """A client's messages of text (RFC 6455)."""

    def __init__(self, host, port, path):
        self.socket = socket.create_connection((host, port), PATIENCE)
        self.input = self.socket.makefile("rb")
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(f"GET {path} HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode())
        answer = b"".join(iter(lambda: self.input.readline() or b"\r\n", b"\r\n"))
        if b" 101 " not in answer:
            raise Failed(answer.decode())

    def send(self, text):
        """In one frame, whose mask Firefox requires to be there and not to be 0."""
        data = text.encode()
        size = len(data)
        length = struct.pack(">B", 0x80 | size) if size < 126 else struct.pack(">BH", 0xfe, size) if size < 1 << 16 else \
            struct.pack(">BQ", 0xff, size)
        self.socket.sendall(b"\x81" + length + b"\1\1\1\1" + bytes(byte ^ 1 for byte in data))

    def read(self, size):
        data = self.input.read(size)
        if len(data) < size:
            raise Failed("the browser ended")
        return data

    def receive(self):
        text = b""
        while True:
            kind, size = self.read(2)
            if size > 125:
                size = int.from_bytes(self.read(2 if size == 126 else 8), "big")
            data = self.read(size)
            if kind & 0xf == 8:
                raise Failed("the browser ended")
            if kind & 0xf < 3:  # else a ping
                text += data
                if kind & 0x80:
                    return text.decode()

    def close(self):
        self.input.close()
        self.socket.close()


def display():
    """An X server, and its name."""
    reading, writing = os.pipe()
    process = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1400x1000x24", "-nolisten", "tcp",
                                "-noreset"], pass_fds=[writing], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    os.close(writing)
    with os.fdopen(reading) as file:
        return process, ":" + file.readline().strip()


class Firefox(Page):
    def __init__(self):
        self.folder = tempfile.mkdtemp()
        self.number, self.events, self.processes, self.socket = 0, [], [], None
        try:
            self.start()
        except BaseException:
            self.close()
            raise

    def start(self):
        profile = pathlib.Path(self.folder, "profile")
        profile.mkdir()
        profile.joinpath("user.js").write_text("".join(f"user_pref({json.dumps(name)}, {json.dumps(value)});\n"
                                                       for name, value in PREFERENCES.items()))
        server, name = display()
        self.processes.append(server)
        # It writes into the folder of its user, too, and with MOZ_HEADLESS has no WebGL.
        usual = {name: value for name, value in os.environ.items() if not name.startswith(("MOZ_", "XDG_"))}
        self.processes.append(subprocess.Popen(
            ["firefox-esr", "--no-remote", "--profile", profile, "--remote-debugging-port", "0", "about:blank"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            env={**usual, "HOME": self.folder, "DISPLAY": name, "GDK_BACKEND": "x11"}))
        address = self.address(profile / "WebDriverBiDiServer.json")
        self.socket = WebSocket(address["ws_host"], address["ws_port"], "/session")
        self.call("session.new", capabilities={})
        self.call("session.subscribe", events=["log.entryAdded"])
        self.context = self.call("browsingContext.getTree")["contexts"][0]["context"]
        self.resize(1280, 900)

    def address(self, path):
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline and self.processes[-1].poll() is None:
            try:
                return json.loads(path.read_text())
            except (FileNotFoundError, ValueError):  # not yet, or not yet whole
                time.sleep(0.1)
        raise Failed("firefox-esr does not start")

    def close(self):
        for process in reversed(self.processes):
            process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        if self.socket:
            self.socket.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def call(self, method, **parameters):
        self.number += 1
        self.socket.send(json.dumps({"id": self.number, "method": method, "params": parameters}))
        while True:
            answer = json.loads(self.socket.receive())
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise Failed(f"{method}: {answer['message']}")
                return answer["result"]
            self.events.append(answer)

    def run(self, script):
        """The value of an expression, a promise's too."""
        answer = self.call("script.evaluate", expression=f"(async () => JSON.stringify(await ({script})))()",
                           target={"context": self.context}, awaitPromise=True, userActivation=True)
        if "exceptionDetails" in answer:
            raise Failed(answer["exceptionDetails"]["text"])
        return json.loads(answer["result"].get("value", "null"))

    def navigate(self, address):
        self.call("browsingContext.navigate", context=self.context, url=address, wait="complete")

    def before_pages(self, script):
        self.call("script.addPreloadScript", functionDeclaration="() => {" + script + "}")

    def complaints(self):
        """What it logged: errors of scripts, violations of the policy, what a script calls an error."""
        self.run("0")
        return [event["params"]["text"] for event in self.events
                if event.get("method") == "log.entryAdded" and event["params"]["level"] == "error"]

    def resize(self, width, height):
        self.call("browsingContext.setViewport", context=self.context, viewport={"width": width, "height": height})
