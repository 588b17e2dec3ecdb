"""A client that says what it likes, from the loopback address that it likes."""

import asyncio
import json
from concurrent.futures import ThreadPoolExecutor

from tests.patience import PATIENCE


def run(coroutine):
    """Run a coroutine in a loop of its own: a browser of other tests has one in this thread."""
    with ThreadPoolExecutor(1) as other:
        return other.submit(asyncio.run, coroutine).result()


class Client:
    """A client of a listener; each request has a connection of its own.

    Parameters
    ----------
    port : int
    address : str, whence it comes
    """

    def __init__(self, port, address="127.0.0.1"):
        self.port, self.address = port, address
        self.own = f"127.0.0.1:{port}"
        self.cookie = None

    async def connect(self):
        """Open a connection: a reader and a writer."""
        return await asyncio.open_connection("127.0.0.1", self.port, local_addr=(self.address, 0))

    async def say(self, raw, hear=asyncio.StreamReader.read):
        """Say bytes and hear all that is answered until the listener closes.

        Parameters
        ----------
        raw : bytes
        hear : coroutine function (StreamReader) -> bytes, where less is to be heard

        Returns
        -------
        bytes, what was answered; empty if the connection was closed without a word
        """
        try:
            reader, writer = await self.connect()
        except OSError:
            return b""
        try:
            writer.write(raw)
            await writer.drain()
            async with asyncio.timeout(PATIENCE):
                return await hear(reader)
        except (ConnectionError, EOFError):  # a TimeoutError is an OSError, too
            return b""
        finally:
            writer.close()

    async def ask(self, method, path, said=None, drop=(), **headers):
        """Ask as a browser on the listener's own page does, but for what is named.

        Parameters
        ----------
        method, path : str
        said : what JSON holds, or bytes, or None
        drop : names of headers that are left out
        headers : others or other ones; ``_`` stands for a hyphen

        Returns
        -------
        (int, dict, bytes) : status (0 without an answer), headers in lower case, body
        """
        body = (
            said if isinstance(said, bytes) else b"" if said is None else json.dumps(said).encode()
        )
        sent = {"host": self.own, "connection": "close", "content-length": len(body)}
        if method not in ("GET", "HEAD"):
            sent["origin"] = f"http://{self.own}"
        if said is not None:
            sent["content-type"] = "application/json"
        if self.cookie:
            sent["cookie"] = self.cookie
        sent |= {name.lower().replace("_", "-"): value for name, value in headers.items()}
        lines = [f"{name}: {value}" for name, value in sent.items() if name not in drop]
        head = "\r\n".join([f"{method} {path} HTTP/1.1", *lines, "", ""])
        return parsed(
            await self.say(head.encode() + body, head_only if method == "HEAD" else one_answer)
        )

    async def enter(self, key):
        """Change a key into a cookie; the status."""
        status, headers, _ = await self.ask("POST", "/enter", {"key": key})
        if "set-cookie" in headers:
            self.cookie = headers["set-cookie"].partition(";")[0]
        return status

    async def state(self):
        """What the listener says that it shows, at once."""
        status, _, body = await self.ask("GET", "/state/999999999")
        return json.loads(body) if status == 200 else status

    async def vote(self, poll, answer):
        """Vote; the status."""
        return (await self.ask("POST", "/vote", {"poll": poll, "answer": answer}))[0]


async def head_only(reader):
    """The head of an answer."""
    return await reader.readuntil(b"\r\n\r\n")


async def one_answer(reader):
    """One answer, whether or not the connection stays open."""
    head = await head_only(reader)
    return head + await reader.readexactly(int(parsed(head)[1].get("content-length", 0)))


def parsed(answered):
    """Status, headers and body of an answer; status 0 of none."""
    head, _, body = answered.partition(b"\r\n\r\n")
    first, *lines = head.decode("latin-1").split("\r\n")
    if not first:
        return 0, {}, b""
    pairs = (line.partition(":") for line in lines)
    return int(first.split()[1]), {name.lower(): value.strip() for name, _, value in pairs}, body
