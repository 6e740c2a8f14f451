"""A small viewer that speaks tev's protocol, for tests: it listens on the loopback interface alone.

Usage: _viewer.py MODE HOST PORT-FILE RESULT-FILE

It writes the port that it listens on into PORT-FILE, takes one connection, and writes what it has seen as JSON into
RESULT-FILE: the pictures that were created, and for each the values of every channel. MODE: read; stop (reads the first
packet and then nothing); close (closes the connection after the first packet); hang (never accepts).
"""
import json
import os
import socket
import struct
import sys
import time


class Stream:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, form):
        values = struct.unpack_from("<" + form, self.data, self.at)
        self.at += struct.calcsize("<" + form)
        return values if len(values) > 1 else values[0]

    def text(self):
        end = self.data.index(0, self.at)
        text, self.at = self.data[self.at:end].decode(), end + 1
        return text

    def finish(self):
        assert self.at == len(self.data), f"{len(self.data) - self.at} bytes are left of a packet"


def receive(connection, count):
    data = b""
    while len(data) < count:
        part = connection.recv(min(1 << 20, count - len(data)))
        if not part:
            assert not data, "the connection ended within a packet"
            return None
        data += part
    return data


def create(packet, pictures):
    packet.take("?")
    name = packet.text()
    width, height, count = packet.take("iii")
    channels = [packet.text() for _ in range(count)]
    pictures[name] = {"width": width, "height": height, "channels": channels, "updates": 0,
                      "values": {c: [None] * (width * height) for c in channels}}


def update(packet, pictures):
    packet.take("?")
    picture = pictures[packet.text()]
    count = packet.take("i")
    channels = [packet.text() for _ in range(count)]
    x0, y0, width, height = packet.take("iiii")
    offsets = [packet.take("q") for _ in channels]
    strides = [packet.take("q") for _ in channels]
    size = max(o + (width * height - 1) * s + 1 for o, s in zip(offsets, strides))
    values = struct.unpack_from(f"<{size}f", packet.data, packet.at)
    packet.at += 4 * size
    picture["updates"] += 1
    for channel, offset, stride in zip(channels, offsets, strides):
        to = picture["values"][channel]
        for y in range(height):
            row = values[offset + y * width * stride:offset + (y + 1) * width * stride:stride]
            start = (y0 + y) * picture["width"] + x0
            to[start:start + width] = row


def main(mode, host, port_file, result_file):
    server = socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET)
    server.bind((host, 0))
    server.listen(1)
    with open(port_file + ".new", "w") as file:
        file.write(str(server.getsockname()[1]))
    os.rename(port_file + ".new", port_file)
    if mode == "hang":
        time.sleep(60)
        return
    connection, _ = server.accept()
    if mode == "stop":
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    pictures = {}
    while True:
        size = receive(connection, 4)
        if size is None:
            break
        packet = Stream(size + receive(connection, struct.unpack("<I", size)[0] - 4))
        packet.at = 4
        kind = packet.take("b")
        {4: create, 6: update}[kind](packet, pictures)
        packet.finish()
        if mode == "close":
            break
        if mode == "stop":
            time.sleep(60)
    connection.close()
    with open(result_file, "w") as file:
        json.dump(pictures, file)


main(*sys.argv[1:])
