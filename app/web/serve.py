#!/usr/bin/env python3
"""serve.py FOLDER [PORT]: serves a folder to browsers on this machine, with the headers without which they give no threads
to a page, and prints its address. PORT: 8000, or the next one that is free."""
import functools
import http.server
import sys


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm"}

    def end_headers(self):
        self.send_header("Cross-Origin-Opener-Policy", "same-origin")
        self.send_header("Cross-Origin-Embedder-Policy", "require-corp")
        self.send_header("Cache-Control", "no-cache")
        super().end_headers()

    def log_message(self, *_):
        pass


def open_server(folder, first):
    for port in range(first, first + 100):
        try:
            return http.server.ThreadingHTTPServer(("127.0.0.1", port), functools.partial(Handler, directory=folder))
        except OSError:
            continue
    sys.exit(f"serve.py: the ports {first} to {first + 99} are all in use")


server = open_server(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 8000)
print(f"http://127.0.0.1:{server.server_port}/ is Tyndall as a page; Ctrl-C ends it", flush=True)
try:
    server.serve_forever()
except KeyboardInterrupt:
    pass
