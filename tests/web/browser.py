"""Drives a headless Chromium through --remote-debugging-pipe (https://chromedevtools.github.io/devtools-protocol)."""
import base64
import contextlib
import fcntl
import json
import os
import shutil
import subprocess
import tempfile
import time

MESA = ("--use-gl=angle", "--use-angle=gl-egl")
SWIFTSHADER = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
PATIENCE = 120  # seconds after which a page counts as hanging, also on a busy machine
SHIFT = 8
KEYS = {" ": ("Space", 32), "Tab": ("Tab", 9), "Enter": ("Enter", 13), "ArrowRight": ("ArrowRight", 39),
        "ArrowUp": ("ArrowUp", 38), "Home": ("Home", 36), "+": ("Equal", 187),
        "Escape": ("Escape", 27), "n": ("KeyN", 78), "z": ("KeyZ", 90)}


class Failed(Exception):
    pass


class Page:
    """What the browsers have in common: one page at a time."""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def wait(self, script):
        """Until an expression is true; its value."""
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            try:
                value = self.run(script)
            except Failed as failed:
                if not self.gone(str(failed)):  # the page goes while it is asked
                    raise
                value = None
            if value:
                return value
            time.sleep(0.05)
        raise Failed(f"not within {PATIENCE} s: {script}; the page says: {self.run('document.body.innerText')[:800]}")

    def open(self, address, ready="document.body.dataset.ready"):
        self.events.clear()
        self.navigate("about:blank")  # a link that differs after # alone would load nothing
        self.wait("location.href === 'about:blank'")
        self.navigate(address)
        if ready:
            self.wait(f"location.href !== 'about:blank' && document.readyState === 'complete' && ({ready})")

    @contextlib.contextmanager
    def before(self, script):
        """Meanwhile a script runs before those of each page that is opened."""
        added = self.before_pages(script)
        try:
            yield
        finally:
            self.no_longer_before_pages(added)

    def show_tab(self, tab):
        """One that is not shown draws no frames."""
        self.tab = tab
        self.bring_to_front()

    def screenshot(self, path, whole=True):
        with open(path, "wb") as file:
            file.write(base64.b64decode(self.captured(whole)))

    def place(self, selector):
        """The middle of an element, scrolled into view, once it has stayed there for a frame."""
        return self.run(f"""new Promise(resolve => {{
            const element = document.querySelector({json.dumps(selector)});
            const look = before => {{
                element.scrollIntoView({{block: "center"}});
                const box = element.getBoundingClientRect();
                const middle = [box.left + box.width / 2, box.top + box.height / 2];
                if (String(middle) === before)
                    resolve(middle);
                else
                    requestAnimationFrame(() => look(String(middle)));
            }};
            look("");
        }})""")

    def click(self, selector):
        x, y = self.place(selector)
        self.mouse("mousePressed", x, y)
        self.mouse("mouseReleased", x, y)

    def drag(self, selector, dx, dy):
        x, y = self.place(selector)
        self.mouse("mousePressed", x, y)
        self.mouse("mouseMoved", x + dx, y + dy)
        self.mouse("mouseReleased", x + dx, y + dy)


class Browser(Page):
    def __init__(self, *options, size=(1280, 900)):
        self.folder = tempfile.mkdtemp()
        theirs_in, ours_out = os.pipe()
        ours_in, theirs_out = os.pipe()

        def pipes():  # 3 and 4 are the protocol's; the ends may be among them
            ends = [fcntl.fcntl(end, fcntl.F_DUPFD, 5) for end in (theirs_in, theirs_out)]
            os.dup2(ends[0], 3)
            os.dup2(ends[1], 4)

        self.process = subprocess.Popen(
            ["chromium", "--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--no-first-run", "--disable-gpu-sandbox",
             "--ignore-gpu-blocklist", "--hide-scrollbars", f"--user-data-dir={self.folder}", *options, "about:blank"],
            stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL, close_fds=False,
            preexec_fn=pipes)
        os.close(theirs_in)
        os.close(theirs_out)
        self.output, self.input = ours_out, os.fdopen(ours_in, "rb")
        self.number, self.tab, self.events, self.rest = 0, None, [], b""
        self.size = size
        self.new_tab()
        self.call("Browser.grantPermissions", permissions=["clipboardReadWrite", "clipboardSanitizedWrite"])

    def new_tab(self):
        """Goes on in another tab; returns that of before, for `show_tab`."""
        before, self.tab = self.tab, None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.tab = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")
        self.resize(*self.size)
        return before

    def bring_to_front(self):
        self.call("Page.bringToFront")

    def close_tab(self, then):
        self.call("Page.close")
        self.show_tab(then)

    def close(self):
        try:
            self.tab = None
            self.call("Browser.close")
            self.process.wait(10)
        except (OSError, Failed, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        os.close(self.output)
        self.input.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def receive(self):
        while b"\0" not in self.rest:
            more = self.input.read1(1 << 16)
            if not more:
                raise Failed("the browser ended")
            self.rest += more
        message, self.rest = self.rest.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.tab:
            message["sessionId"] = self.tab
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.output, data):]
        while True:
            answer = self.receive()
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise Failed(f"{method}: {answer['error']['message']}")
                return answer["result"]
            self.events.append(answer)

    def run(self, script):
        """The value of an expression, a promise's too."""
        answer = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True,
                           userGesture=True, allowUnsafeEvalBlockedByCSP=False)
        if "exceptionDetails" in answer:
            details = answer["exceptionDetails"]
            raise Failed(details.get("exception", {}).get("description") or details["text"])
        return answer["result"].get("value")

    def navigate(self, address):
        self.call("Page.navigate", url=address)

    @staticmethod
    def gone(message):
        """Whether a page did not answer because another came."""
        return "navigated" in message

    def before_pages(self, script):
        return self.call("Page.addScriptToEvaluateOnNewDocument", source=script)["identifier"]

    def no_longer_before_pages(self, added):
        self.call("Page.removeScriptToEvaluateOnNewDocument", identifier=added)

    def complaints(self):
        """What the browser logged: errors of scripts, violations of the policy."""
        self.run("0")
        said = []
        for event in self.events:
            if event.get("method") == "Runtime.exceptionThrown":
                details = event["params"]["exceptionDetails"]
                said.append(details.get("exception", {}).get("description") or details["text"])
            elif event.get("method") == "Log.entryAdded" and event["params"]["entry"]["level"] == "error":
                said.append(event["params"]["entry"]["text"])
        return said

    def requests(self):
        """The addresses that were asked for."""
        self.run("0")
        return [event["params"]["request"]["url"] for event in self.events
                if event.get("method") == "Network.requestWillBeSent"]

    def resize(self, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def media(self, medium="", dark=False, reduced=False):
        """What the page is shown on, and what its reader prefers."""
        self.call("Emulation.setEmulatedMedia", media=medium, features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"},
            {"name": "prefers-reduced-motion", "value": "reduce" if reduced else "no-preference"}])

    def captured(self, whole):
        return self.call("Page.captureScreenshot", captureBeyondViewport=whole)["data"]

    def pdf(self):
        return base64.b64decode(self.call("Page.printToPDF")["data"])

    def downloads(self, folder):
        """Where files are saved from now on."""
        self.call("Page.setDownloadBehavior", behavior="allow", downloadPath=folder)

    def choose_files(self, selector, *paths):
        root = self.call("DOM.getDocument")["root"]["nodeId"]
        node = self.call("DOM.querySelector", nodeId=root, selector=selector)["nodeId"]
        self.call("DOM.setFileInputFiles", nodeId=node, files=[str(path) for path in paths])

    def unnamed(self):
        """The roles of what is focusable and has no name for a screen reader; and how many have one."""
        roles, named = [], 0
        for node in self.call("Accessibility.getFullAXTree")["nodes"]:
            properties = {item["name"]: item["value"].get("value") for item in node.get("properties", [])}
            if properties.get("focusable") and node["role"]["value"] not in ("RootWebArea", "generic"):
                if node.get("name", {}).get("value"):
                    named += 1
                else:
                    roles.append(node["role"]["value"])
        return roles, named

    def mouse(self, kind, x, y):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=0 if kind == "mouseReleased" else 1,
                  clickCount=1)

    def touch(self, kind, *places):
        """Of all fingers that are down, one after another, or none at the end."""
        self.call("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(places)])

    def drop(self, selector, path):
        """A file from outside of the browser. The page has to take it itself, else a browser with a window opens the file."""
        x, y = self.place(selector)
        self.run("""(() => {
            window.taken = [];
            for (const kind of ["dragover", "drop"])
                window.addEventListener(kind, event => taken.push(event.defaultPrevented), {once: true});
        })()""")
        for number, kind in enumerate(("dragEnter", "dragOver", "drop")):
            self.call("Input.dispatchDragEvent", type=kind, x=x, y=y,
                      data={"items": [], "files": [path], "dragOperationsMask": 1})
            self.wait(f"taken.length === {number}")
            if not self.run("taken.every(taken => taken)"):
                raise Failed(f"{selector}: a dropped file is opened instead of the page")

    def type(self, text):
        self.call("Input.insertText", text=text)

    def key(self, key, modifiers=0):
        code, number = KEYS[key]
        text = {"text": key} if len(key) == 1 else {"text": "\r"} if key == "Enter" else {}
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=code, windowsVirtualKeyCode=number,
                      modifiers=modifiers, **(text if kind == "keyDown" else {}))
