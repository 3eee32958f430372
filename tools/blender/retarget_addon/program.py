"""The program in the background: started, listened to, stopped."""

import collections
import json
import os
import pathlib
import shutil
import signal
import subprocess
import threading

import bpy


def find(preferred=""):
    """The program's path; empty where there is none."""
    for candidate in (preferred, os.environ.get("RETARGET_BINARY", ""), "retarget"):
        if candidate:
            path = shutil.which(bpy.path.abspath(candidate))
            if path:
                return path
    return ""


def libraries(program, extra=""):
    """Folders with templates: the user's, then those that came with the program."""
    folders = [extra] if extra else []
    prefix = pathlib.Path(program).resolve().parent
    for share in (prefix.parent / "share" / "retarget", prefix.parent.parent / "data"):
        folders.extend(str(share / name) for name in ("templates", "holds"))
    return [folder for folder in folders if os.path.isdir(folder)]


def templates(folders):
    """(name, path of the YAML, path of a picture or empty), in the order of the folders."""
    found = []
    for folder in map(pathlib.Path, folders):
        for path in sorted([*folder.glob("*.yaml"), *folder.glob("*/template.yaml")]):
            name = path.parent.name if path.name == "template.yaml" else path.stem
            picture = path.with_suffix(".png")
            found.append((name, str(path), str(picture) if picture.exists() else ""))
    return found


class Job:
    """One run of the program."""

    def __init__(self, arguments):
        self.progress = {}
        self.messages = collections.deque(maxlen=50)
        self.process = subprocess.Popen(
            arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            errors="replace", stdin=subprocess.DEVNULL,
        )
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self.process.stdout:
            line = line.rstrip("\n")
            if line.startswith('{"stage":'):
                try:
                    self.progress = json.loads(line)
                    continue
                except ValueError:
                    pass
            if line:
                self.messages.append(line)

    def poll(self):
        """The exit code, or None while it runs."""
        code = self.process.poll()
        if code is not None:
            self._reader.join(timeout=10)
        return code

    def wait(self):
        self.process.wait()
        return self.poll()

    def cancel(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGKILL)
            self.process.wait()

    def error(self):
        """What the program said was wrong."""
        for line in reversed(self.messages):
            if line.startswith("retarget: "):
                return line[len("retarget: "):]
        return self.messages[-1] if self.messages else "the program ended without a word"

    def describe(self):
        if not self.progress:
            return "Starting"
        p = self.progress
        return (f"Iteration {p['iteration']}: s GLI {p['smallest_gli']:.2f}, "
                f"depth {100 * p['penetration_m']:.1f} cm, {p['seconds']:.0f} s")
