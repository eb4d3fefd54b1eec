"""A headless Chromium that a test controls through its DevTools pipe."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

# Time limit, s, far above the time that the browser needs for one command.
ANSWER_SECONDS = 120

SOFTWARE_WEBGL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
NO_WEBGL = ("--disable-gpu", "--disable-3d-apis")


class Browser:
    """One page of a browser process. Close it after use."""

    def __init__(self, flags=SOFTWARE_WEBGL):
        program = shutil.which("chromium")
        if program is None:
            raise FileNotFoundError("chromium is not installed: run scripts/setup --test")
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        read_commands, self.commands = os.pipe()
        self.answers, write_answers = os.pipe()

        def set_up_pipe():
            # The browser reads commands from descriptor 3 and answers on descriptor 4.
            source, sink = os.dup(read_commands), os.dup(write_answers)
            os.dup2(source, 3)
            os.dup2(sink, 4)

        self.process = subprocess.Popen(
            [program, "--headless=new", "--no-sandbox", "--hide-scrollbars", "--remote-debugging-pipe",
             "--user-data-dir=" + self.folder.name, *flags, "about:blank"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            close_fds=False, preexec_fn=set_up_pipe)
        os.close(read_commands)
        os.close(write_answers)
        self.number, self.buffer, self.session, self.loaded = 0, b"", None, False
        self.console = []  # texts of console messages and exceptions since the last open()
        self.requests = []  # addresses of requests since the last open()
        targets = self.command("Target.getTargets")["targetInfos"]
        page = next(target["targetId"] for target in targets if target["type"] == "page")
        self.session = self.command("Target.attachToTarget", targetId=page, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.command(domain + ".enable")

    def close(self):
        self.process.terminate()
        self.process.wait()
        os.close(self.commands)
        os.close(self.answers)
        self.folder.cleanup()

    def command(self, method, **parameters):
        """Send a command and return its result."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.commands, json.dumps(message).encode() + b"\0")
        while (answer := self.receive()).get("id") != self.number:
            self.note(answer)
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']['message']}")
        return answer["result"]

    def receive(self):
        end = time.monotonic() + ANSWER_SECONDS
        while b"\0" not in self.buffer:
            if not select.select([self.answers], [], [], max(0, end - time.monotonic()))[0]:
                raise TimeoutError("the browser does not answer")
            self.buffer += os.read(self.answers, 1 << 20)
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def note(self, event):
        method, parameters = event.get("method"), event.get("params", {})
        if method == "Runtime.consoleAPICalled":
            self.console.append(" ".join(str(each.get("value", "")) for each in parameters["args"]))
        elif method == "Runtime.exceptionThrown":
            self.console.append(json.dumps(parameters["exceptionDetails"]))
        elif method == "Log.entryAdded":
            self.console.append(parameters["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(parameters["request"]["url"])
        elif method == "Page.loadEventFired":
            self.loaded = True

    def resize(self, width, height, dark=False, media=""):
        self.command("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                     mobile=False)
        self.command("Emulation.setEmulatedMedia", media=media,
                     features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])

    def open(self, address):
        """Open a page and wait until it is loaded and its scripts have run."""
        self.navigate("about:blank")
        self.console, self.requests = [], []
        self.navigate(address)

    def navigate(self, address):
        self.loaded = False
        self.command("Page.navigate", url=address)
        while not self.loaded:
            self.note(self.receive())

    def value(self, script):
        """Return the value of a JavaScript expression in the page."""
        result = self.command("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(json.dumps(result["exceptionDetails"]))
        return result["result"].get("value")

    def press(self, key, code=0):
        """Press and release a key: "ArrowRight", "3", " "."""
        text = {"text": key} if len(key) == 1 else {}
        self.command("Input.dispatchKeyEvent", type="keyDown", key=key, windowsVirtualKeyCode=code, **text)
        self.command("Input.dispatchKeyEvent", type="keyUp", key=key, windowsVirtualKeyCode=code)

    def screenshot(self, selector=None):
        """Return a PNG of the window, or of the first element with a CSS selector."""
        options = {}
        if selector:
            box = json.loads(self.value(
                f"JSON.stringify((b => [b.x + scrollX, b.y + scrollY, b.width, b.height])"
                f"(document.querySelector({json.dumps(selector)}).getBoundingClientRect()))"))
            options["clip"] = dict(zip(("x", "y", "width", "height"), box), scale=1)
            options["captureBeyondViewport"] = True
        return base64.b64decode(self.command("Page.captureScreenshot", format="png", **options)["data"])
