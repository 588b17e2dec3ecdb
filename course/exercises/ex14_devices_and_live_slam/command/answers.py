# %% way: small letters
def command(speed, turn):
    T, R = (max(-100, min(100, each)) % 256 for each in (speed, turn))
    C = -(1 + T + R) % 256
    return f"#01{T:02x}{R:02x}{C:02x}/"

# %% way: bytes
def command(speed, turn):
    T, R = (int(np.clip(each, -100, 100)) & 0xFF for each in (speed, turn))
    C = (256 - (1 + T + R) % 256) % 256
    return (b"#%02X%02X%02X%02X/" % (1, T, R, C)).decode()

# %% way: int.to_bytes
def command(speed, turn):
    head = b"\x01"
    for number in np.clip([speed, turn], -100, 100).tolist():
        head += number.to_bytes(1, "big", signed=True)
    return "#" + (head + bytes([-sum(head) & 255])).hex().upper() + "/"

# %% way: struct
import struct

def command(speed, turn):
    limited = [min(max(each, -100), 100) for each in (speed, turn)]
    data = struct.pack("bbb", 1, *limited)
    return "#{}{:02X}/".format(data.hex(), (~sum(data) + 1) & 0xFF)

# %% way: by hand
def command(speed, turn):
    numbers = [1]
    for number in (speed, turn):
        if number > 100:
            number = 100
        elif number < -100:
            number = -100
        if number < 0:
            number = number + 256
        numbers.append(number)
    missing = 0
    while (sum(numbers) + missing) % 256 != 0:
        missing += 1
    digits = "0123456789ABCDEF"
    text = "".join(digits[n // 16] + digits[n % 16] for n in numbers + [missing])
    return "#" + text + "/"

# %% right: bytes.hex and struct
import struct

def command(speed, turn):
    body = struct.pack(">Bbb", 1, min(max(speed, -100), 100), min(max(turn, -100), 100))
    total = sum(body)
    return "#" + (body + bytes([(256 - total % 256) % 256])).hex().upper() + "/"

# %% right: two's complement by struct
def command(speed, turn):
    import struct
    v = struct.pack("bb", int(np.clip(speed, -100, 100)), int(np.clip(turn, -100, 100)))
    body = bytes([1]) + v
    frame = bytes([0]) + body if False else body
    total = sum(frame) % 256
    return "#" + (frame + bytes([(-total) % 256])).hex().upper() + "/"

# %% right: checksum from the signed numbers, bytes by formatting
def command(speed, turn):
    s, t = sorted((-100, speed, 100))[1], sorted((-100, turn, 100))[1]
    check = (-1 - s - t) & 0xFF
    return "#01%02X%02X%02X/" % (s & 0xFF, t & 0xFF, check)

# %% right: with bytes
def command(speed, turn):
    t, r = (int(np.clip(v, -100, 100)) & 0xFF for v in (speed, turn))
    body = bytes([1, t, r, (256 - (1 + t + r) % 256) % 256])
    return f"#{body.hex().upper()}/"

# %% wrong: too large numbers scaled together
def command(speed, turn):
    most = max(abs(speed), abs(turn), 100)
    t, r = round(speed * 100 / most) % 256, round(turn * 100 / most) % 256
    return f"#01{t:02X}{r:02X}{-(1 + t + r) % 256:02X}/"

# %% wrong: bytes instead of str
def command(speed, turn):
    data = bytes([1] + [max(-100, min(100, each)) % 256 for each in (speed, turn)])
    return b"#" + (data + bytes([-sum(data) % 256])).hex().upper().encode() + b"/"
