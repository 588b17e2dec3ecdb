"""HTTP client that sends any bytes from any loopback address."""

import asyncio
import json
from concurrent.futures import ThreadPoolExecutor

from tests.timeouts import PATIENCE


def run(coroutine):
    """Run a coroutine in another thread: browser tests have an event loop in this one."""
    with ThreadPoolExecutor(1) as other:
        return other.submit(asyncio.run, coroutine).result()


class Client:
    """A client of a server at a port, from an address; each request has its own connection."""

    def __init__(self, port, address="127.0.0.1"):
        self.port, self.address = port, address
        self.own = f"127.0.0.1:{port}"
        self.cookie = None

    async def connect(self):
        """Open a connection: a reader and a writer."""
        return await asyncio.open_connection("127.0.0.1", self.port, local_addr=(self.address, 0))

    async def send(self, raw, read=asyncio.StreamReader.read):
        """Send bytes; the response, or no bytes if the connection was closed without one.

        ``read`` is a coroutine function of a StreamReader; as given it reads until the server
        closes.
        """
        try:
            reader, writer = await self.connect()
        except OSError:
            return b""
        try:
            writer.write(raw)
            await writer.drain()
            async with asyncio.timeout(PATIENCE):
                return await read(reader)
        except (ConnectionError, EOFError):  # a TimeoutError is an OSError, too
            return b""
        finally:
            writer.close()

    async def ask(self, method, path, content=None, drop=(), **headers):
        """Send a request as a browser on the server's own page, except for what is given.

        The content is sent as JSON, or as bytes. ``drop`` names headers to leave out; in the names
        of more headers, ``_`` stands for a hyphen. The answer is the status (0 without one), the
        headers in lower case, and the body.
        """
        body = b"" if content is None else content
        if not isinstance(body, bytes):
            body = json.dumps(body).encode()
        sent = {"host": self.own, "connection": "close", "content-length": len(body)}
        if method not in ("GET", "HEAD"):
            sent["origin"] = f"http://{self.own}"
        if content is not None:
            sent["content-type"] = "application/json"
        if self.cookie:
            sent["cookie"] = self.cookie
        sent |= {name.lower().replace("_", "-"): value for name, value in headers.items()}
        lines = [f"{name}: {value}" for name, value in sent.items() if name not in drop]
        head = "\r\n".join([f"{method} {path} HTTP/1.1", *lines, "", ""])
        return parsed(
            await self.send(head.encode() + body, head_only if method == "HEAD" else one_answer)
        )

    async def log_in(self, key):
        """Exchange a key for a cookie; return the status."""
        status, headers, _ = await self.ask("POST", "/login", {"key": key})
        if "set-cookie" in headers:
            self.cookie = headers["set-cookie"].partition(";")[0]
        return status

    async def state(self):
        """State of the lecture, without waiting for a change."""
        status, _, body = await self.ask("GET", "/state/999999999")
        return json.loads(body) if status == 200 else status

    async def vote(self, poll, answer):
        """Vote; return the status."""
        return (await self.ask("POST", "/vote", {"poll": poll, "answer": answer}))[0]


async def head_only(reader):
    """Head of a response."""
    return await reader.readuntil(b"\r\n\r\n")


async def one_answer(reader):
    """One response, whether or not the connection stays open."""
    head = await head_only(reader)
    return head + await reader.readexactly(int(parsed(head)[1].get("content-length", 0)))


def parsed(answered):
    """Status, headers and body of a response; status 0 if there is none."""
    head, _, body = answered.partition(b"\r\n\r\n")
    first, *lines = head.decode("latin-1").split("\r\n")
    if not first:
        return 0, {}, b""
    pairs = (line.partition(":") for line in lines)
    return int(first.split()[1]), {name.lower(): value.strip() for name, _, value in pairs}, body
