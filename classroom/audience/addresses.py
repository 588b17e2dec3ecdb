"""Network addresses of this machine for phones, with QR codes."""

import io
import ipaddress
import socket

import psutil
import segno


def reachable(host):
    """Return the addresses of a server on a host ("0.0.0.0": all), private addresses first."""
    if host != "0.0.0.0":
        return [host]
    up = {name for name, state in psutil.net_if_stats().items() if state.isup}
    found = {
        ipaddress.ip_address(address.address)
        for name, addresses in psutil.net_if_addrs().items()
        for address in addresses
        if name in up and address.family == socket.AF_INET
    }
    usable = [one for one in found if not one.is_loopback and not one.is_link_local]
    usable.sort(key=lambda one: (not one.is_private, one))
    return [str(one) for one in usable] or ["127.0.0.1"]


def qr_code(text):
    written = io.BytesIO()
    code = segno.make_qr(text, error="m")
    code.save(written, kind="svg", xmldecl=False, svgns=True, omitsize=True, light="#ffffff")
    return written.getvalue().decode()
