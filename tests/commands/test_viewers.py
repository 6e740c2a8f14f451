"""render --watch-at: the picture in a viewer that speaks tev's protocol, and viewers that fail. Loopback only."""

import contextlib
import io
import socket
import struct
import threading
import time

import pytest
from program import pixels_of, read, run

SCENE = "render cornell-box --size 48x32 --spp 16 -q"


class Packet(io.BytesIO):
    def take(self, form):
        values = struct.unpack("<" + form, self.read(struct.calcsize("<" + form)))
        return values if len(values) > 1 else values[0]

    def text(self):
        return b"".join(iter(lambda: self.read(1), b"\0")).decode()


class Viewer(threading.Thread):
    """Takes one connection, and keeps the pictures that were created with the values of every channel. mode: read; stop
    (reads the first packet and then nothing); close (closes the connection after the first packet); hang (never
    accepts)."""

    def __init__(self, mode="read", host="127.0.0.1"):
        super().__init__()
        self.mode, self.pictures, self.problem, self.done = mode, {}, None, threading.Event()
        self.server = socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET)
        self.server.bind((host, 0))
        self.server.listen(1)
        self.port = self.server.getsockname()[1]
        self.start()

    def run(self):
        with contextlib.closing(self.server):
            if self.mode == "hang":
                self.done.wait()
                return
            connection, _ = self.server.accept()
        with connection, connection.makefile("rb") as stream:
            if self.mode == "stop":
                connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            try:
                while size := stream.read(4):
                    data = stream.read(struct.unpack("<I", size)[0] - 4)
                    packet = Packet(data)
                    {4: self.create, 6: self.update}[packet.take("b")](packet, data)
                    assert packet.tell() == len(data), "bytes are left of a packet"
                    if self.mode != "read":
                        self.done.wait(60 if self.mode == "stop" else 0)
                        break
            except Exception as problem:  # whatever is wrong with a packet
                self.problem = problem

    def create(self, packet, _):
        packet.take("?")
        name = packet.text()
        width, height, count = packet.take("iii")
        self.pictures[name] = (width, height, {packet.text(): [None] * (width * height) for _ in range(count)})

    def update(self, packet, data):
        packet.take("?")
        width, _, values = self.pictures[packet.text()]
        channels = [packet.text() for _ in range(packet.take("i"))]
        x0, y0, columns, rows = packet.take("iiii")
        offsets, strides = ([packet.take("q") for _ in channels] for _ in range(2))
        size = max(o + (columns * rows - 1) * s + 1 for o, s in zip(offsets, strides))
        sent = packet.take(f"{size}f")
        for channel, offset, stride in zip(channels, offsets, strides):
            for y in range(rows):
                at = (y0 + y) * width + x0
                values[channel][at:at + columns] = sent[offset + y * columns * stride::stride][:columns]

    def seen(self):
        self.join(60)
        assert not self.is_alive() and self.problem is None, self.problem
        (name, picture), = self.pictures.items()
        assert name == "cornell-box" and picture[:2] == (48, 32)
        return picture[2]


def has_ipv6():
    try:
        with socket.socket(socket.AF_INET6) as probe:
            probe.bind(("::1", 0))
        return True
    except OSError:
        return False


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", pytest.param("[::1]", marks=pytest.mark.skipif(
    not has_ipv6(), reason="no IPv6"))])
def test_picture(host):
    """What the viewer has in the end is the picture: R, G, B, the error, the clean view."""
    viewer = Viewer(host=host.strip("[]").replace("localhost", "127.0.0.1"))
    run(f"{SCENE} --denoise -o picture.pfm --watch-at {host}:{viewer.port}")
    values = viewer.seen()
    assert list(values) == ["R", "G", "B", "error", "clean.R", "clean.G", "clean.B"]
    assert all(None not in channel for channel in values.values())
    rows = [pixel for row in pixels_of("picture.pfm") for pixel in row]
    for k, name in enumerate(("clean.R", "clean.G", "clean.B")):
        assert [pixel[k] for pixel in rows] == values[name], name
    assert 0.01 < sum(values["error"]) / 1536 < 1
    assert values["R"] != values["clean.R"] and abs(sum(values["R"]) / sum(values["clean.R"]) - 1) < 0.1


def test_region():
    """The viewer gets the whole picture's place."""
    viewer = Viewer()
    run(f"{SCENE} --region 8,4,20,10 -o part.pfm --watch-at 127.0.0.1:{viewer.port}")
    assert sum(value is not None for value in viewer.seen()["R"]) == 72


def test_no_viewer():
    """The same picture, exit code 0, at most one line."""
    run(f"{SCENE} -o plain.pfm")
    run(f"{SCENE} -o nobody.pfm --watch-at 127.0.0.1:1", 0,
        "--watch-at: 127.0.0.1:1: Connection refused; the render goes on without it")
    run(f"{SCENE} -o name.pfm --watch-at no-such-host.invalid", lines=1)
    assert read("plain.pfm") == read("nobody.pfm") == read("name.pfm")


@pytest.mark.parametrize("mode", ["stop", "close", "hang"])
def test_viewers_that_fail(mode):
    """One that stops reading, closes or never accepts: nobody waits for it."""
    large = "render cornell-box --size 640x480 --spp 4 -q"
    viewer, start = Viewer(mode), time.monotonic()
    try:
        words = [] if mode == "hang" else [f"tyndall: --watch-at: 127.0.0.1:{viewer.port}: the viewer has "]
        run(f"{large} -o watched.pfm --watch-at 127.0.0.1:{viewer.port}", 0, *words, lines=1)
        assert time.monotonic() - start < 10
    finally:
        viewer.done.set()
        viewer.join()
    run(f"{large} -o plain.pfm")
    assert read("plain.pfm") == read("watched.pfm")
