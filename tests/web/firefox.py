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

PREFERENCES = {
    # Else there is no WebGL by a software renderer, and no more of its name than "llvmpipe, or similar".
    "webgl.force-enabled": True, "webgl.sanitize-unmasked-renderer": False,
    "dom.events.testing.asyncClipboard": True,  # a page reads the clipboard without asking
    "dom.w3c_touch_events.enabled": 1,  # also without a touch screen
    # A busy machine makes of a swipe or a tap no long one, and lets the page decide what a touch does.
    "apz.content_response_timeout": 600000, "apz.max_tap_time": 600000, "ui.click_hold_context_menus.delay": 600000,
}
NEEDS = ("firefox-esr", "Xvfb")


def missing():
    """Which of the programs that it needs is not there, or None."""
    return next((tool for tool in NEEDS if not shutil.which(tool)), None)


# https://www.w3.org/TR/webdriver2/#keyboard-actions
KEYS = {"Tab": "\ue004", "Enter": "\ue007", "ArrowRight": "\ue014", "ArrowUp": "\ue013", "Home": "\ue011", "Escape": "\ue00c"}
MODIFIERS = {2: "\ue009", 8: "\ue008"}  # as Chromium counts them: Control and Shift
# The files that elements of the page loaded: the protocol tells of the network alone.
LOADED = """window.loadedFiles = [];
document.addEventListener("load", event => loadedFiles.push(event.target.src || event.target.href), true);"""
# As the process of the window sees the page's tree, once the page's own process has sent it.
UNNAMED = """(async () => {
    const service = Cc["@mozilla.org/accessibilityService;1"].getService(Ci.nsIAccessibilityService);
    const {selectedBrowser} = gBrowser, found = {};
    const look = part => {
        const state = {};
        part.getState(state, {});
        found.busy ||= state.value & Ci.nsIAccessibleStates.STATE_BUSY;
        const role = service.getStringRole(part.role);
        // A text container has no role that is read, as Chromium's generic.
        if (state.value & Ci.nsIAccessibleStates.STATE_FOCUSABLE && !["document", "internal frame", "text container"].includes(role))
            if (part.name) found.named++; else found.roles.push(role);
        for (let i = 0; i < part.childCount; i++)
            look(part.getChildAt(i));
    };
    for (let before = ""; ; before = JSON.stringify(found)) {
        await new Promise(done => setTimeout(done, 300));
        Object.assign(found, {busy: 0, roles: [], named: 0});
        const root = service.getAccessibleFor(selectedBrowser);
        if (root)
            look(root);
        if (found.named && !found.busy && JSON.stringify(found) === before)
            return before;
    }
})()"""


def plain(value):
    """As JSON has it, of what the protocol calls a remote value."""
    kind, value = value["type"], value.get("value")
    if kind in ("array", "nodelist", "htmlcollection"):
        return [plain(part) for part in value]
    if kind == "object":
        return {key: plain(part) for key, part in value if part["type"] != "undefined"}
    return value if kind in ("string", "boolean") else float(value) if kind == "number" and isinstance(value, str) else \
        value if kind == "number" else {} if kind not in ("null", "undefined") else None


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
            ["firefox-esr", "--no-remote", "--remote-allow-system-access", "--profile", profile, "--remote-debugging-port", "0", "about:blank"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            env={**usual, "HOME": self.folder, "DISPLAY": name, "GDK_BACKEND": "x11"}))
        address = self.address(profile / "WebDriverBiDiServer.json")
        self.socket = WebSocket(address["ws_host"], address["ws_port"], "/session")
        self.call("session.new", capabilities={})
        self.call("session.subscribe", events=["log.entryAdded", "network.beforeRequestSent"])
        self.tab = self.call("browsingContext.getTree")["contexts"][0]["context"]
        self.window = self.call("browsingContext.getTree", **{"moz:scope": "chrome"})["contexts"][0]["context"]
        self.before_pages(LOADED)
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

    def evaluate(self, script, context):
        answer = self.call("script.evaluate", expression=script, target={"context": context}, awaitPromise=True,
                           userActivation=True, resultOwnership="none")
        if "exceptionDetails" in answer:
            raise Failed(answer["exceptionDetails"]["text"])
        return plain(answer["result"])

    def run(self, script):
        """The value of an expression, a promise's too."""
        return self.evaluate(script, self.tab)

    def of_window(self, script):
        """The same of the browser's own window, whose scripts may do what its user can."""
        return self.evaluate(script, self.window)

    def navigate(self, address):
        self.call("browsingContext.navigate", context=self.tab, url=address, wait="complete")
        # As a click of its user does, else the field of the address has the focus, and the page gets neither blur nor change.
        self.of_window("gBrowser.selectedBrowser.focus()")

    @staticmethod
    def gone(message):
        return "AbortError" in message or "no such frame" in message or "Actor" in message

    def before_pages(self, script):
        return self.call("script.addPreloadScript", functionDeclaration="() => {" + script + "}")["script"]

    def no_longer_before_pages(self, added):
        self.call("script.removePreloadScript", script=added)

    def new_tab(self):
        before = self.tab
        self.tab = self.call("browsingContext.create", type="tab")["context"]
        self.resize(1280, 900)
        return before

    def bring_to_front(self):
        self.call("browsingContext.activate", context=self.tab)

    def close_tab(self, then):
        self.call("browsingContext.close", context=self.tab)
        self.show_tab(then)

    def complaints(self):
        """What it logged: errors of scripts, violations of the policy, what a script calls an error."""
        self.run("0")
        return [event["params"]["text"] for event in self.events
                if event.get("method") == "log.entryAdded" and event["params"]["level"] == "error"]

    def requests(self):
        """The addresses that were asked for, of files those that came."""
        files = self.run("loadedFiles.filter(file => file)")
        return files + [event["params"]["request"]["url"] for event in self.events if event.get("method") == "network.beforeRequestSent"]

    def resize(self, width, height):
        self.call("browsingContext.setViewport", context=self.tab, viewport={"width": width, "height": height})

    def media(self, medium="", dark=False, reduced=False):
        self.of_window(f"""{{
            const {{browsingContext}} = gBrowser.selectedBrowser;
            browsingContext.mediumOverride = {json.dumps(medium)};
            browsingContext.prefersColorSchemeOverride = {json.dumps("dark" if dark else "light")};
            Services.prefs.setIntPref("ui.prefersReducedMotion", {int(reduced)});
        }}""")
        seen = [f"matchMedia('(prefers-reduced-motion: reduce)').matches === {json.dumps(reduced)}", f"matchMedia('{medium or 'screen'}').matches"]
        if not medium:  # paper is light
            seen.append(f"matchMedia('(prefers-color-scheme: dark)').matches === {json.dumps(dark)}")
        self.wait(" && ".join(seen))

    def captured(self, whole):
        return self.call("browsingContext.captureScreenshot", context=self.tab, origin="document" if whole else "viewport")["data"]

    def pdf(self):
        return base64.b64decode(self.call("browsingContext.print", context=self.tab)["data"])

    def downloads(self, folder):
        self.call("browser.setDownloadBehavior", downloadBehavior={"type": "allowed", "destinationFolder": folder})

    def choose_files(self, selector, *paths):
        found = self.call("browsingContext.locateNodes", context=self.tab, locator={"type": "css", "value": selector})["nodes"]
        self.call("input.setFiles", context=self.tab, element={"sharedId": found[0]["sharedId"]}, files=[str(path) for path in paths])

    def unnamed(self):
        found = json.loads(self.of_window(UNNAMED))
        return found["roles"], found["named"]

    def perform(self, source, *actions):
        self.call("input.performActions", context=self.tab, actions=[{**source, "actions": list(actions)}])

    def mouse(self, kind, x, y):
        press = {"mousePressed": "pointerDown", "mouseReleased": "pointerUp"}
        self.perform({"type": "pointer", "id": "mouse"}, {"type": "pointerMove", "x": x, "y": y},
                     *([{"type": press[kind], "button": 0}] if kind in press else []))

    def touch(self, kind, *places):
        """As if the display were touched."""
        if places:
            self.fingers = places
        self.of_window(f"""(() => {{
            const box = gBrowser.selectedBrowser.getBoundingClientRect();
            const state = windowUtils.{"TOUCH_CONTACT" if places else "TOUCH_REMOVE"};
            for (const [finger, [x, y]] of {json.dumps(self.fingers)}.entries())
                windowUtils.sendNativeTouchPoint(finger, state, mozInnerScreenX + box.left + x, mozInnerScreenY + box.top + y, 1, 0);
        }})()""")
        self.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")

    def drop(self, selector, path):
        """A file from outside of the browser, which a field that is there for a moment reads."""
        self.run("document.body.append(Object.assign(document.createElement('input'), {type: 'file', id: 'from-outside'}))")
        self.choose_files("#from-outside", path)
        taken = self.run(f"""(() => {{
            const field = document.getElementById("from-outside"), dataTransfer = new DataTransfer();
            dataTransfer.items.add(field.files[0]);
            field.remove();
            return ["dragenter", "dragover", "drop"].map(kind => !document.querySelector({json.dumps(selector)}).dispatchEvent(
                new DragEvent(kind, {{dataTransfer, bubbles: true, cancelable: true, composed: true}})));
        }})()""")
        if not all(taken[1:]):
            raise Failed(f"{selector}: a dropped file is opened instead of the page")

    def type(self, text):
        self.run(f"document.execCommand('insertText', false, {json.dumps(text)})")

    def key(self, key, modifiers=0):
        held = [MODIFIERS[bit] for bit in MODIFIERS if modifiers & bit]
        self.perform({"type": "key", "id": "keys"}, *({"type": "keyDown", "value": name} for name in held),
                     *({"type": kind, "value": KEYS.get(key, key)} for kind in ("keyDown", "keyUp")),
                     *({"type": "keyUp", "value": name} for name in held))
