#!/usr/bin/env python3
"""Scan and settle: a PI controller for stage.json, over UDP or shared memory. Python's standard library alone.

  stickslip realtime docs/realtime/stage.json --period "100 us" --for "2 s" --channels stage.x_m --notes target.x_m,error_m \
      --inputs udp:127.0.0.1:5005 --outputs udp:127.0.0.1:5006
  python3 docs/realtime/client.py udp 127.0.0.1 5005 5006

  stickslip realtime docs/realtime/stage.json --period "100 us" --for "2 s" --channels stage.x_m --notes target.x_m,error_m \
      --inputs shm:stage --outputs shm:stage
  python3 docs/realtime/client.py shm stage
"""
import math, mmap, os, socket, struct, sys, time

HEAD = struct.Struct("<4sHHQQd")  # magic, version, number of values, scenario, sequence, time stamp


def pack(scenario, sequence, stamp, values):
    return HEAD.pack(b"sslp", 1, len(values), scenario, sequence, stamp) + struct.pack(f"<{len(values)}d", *values)


def unpack(packet):
    magic, version, count, scenario, sequence, stamp = HEAD.unpack_from(packet)
    assert (magic, version) == (b"sslp", 1) and len(packet) == HEAD.size + 8 * count
    return scenario, sequence, stamp, struct.unpack_from(f"<{count}d", packet, HEAD.size)


class Udp:
    """Outputs come to a port of ours; inputs go to the loop's."""

    def __init__(self, host, to, own):
        self.to, self.socket = (host, int(to)), socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind((host, int(own)))
        self.patience = 20.0  # the loop measures itself before it speaks

    def receive(self):
        """The newest packet; None when the loop has fallen silent."""
        self.socket.settimeout(self.patience)
        self.patience = 1.0
        try:
            packet = self.socket.recv(2048)
            self.socket.setblocking(False)
            while True:
                packet = self.socket.recv(2048)
        except BlockingIOError:
            return packet
        except socket.timeout:
            return None

    def send(self, packet):
        self.socket.sendto(packet, self.to)


class Memory:
    """Both records lie in one file. The counter of a record is odd while it is written. (On x86; elsewhere use C.)

    Python cannot claim a record, which takes one step that nobody comes between: with it only one client may write at a time."""

    def __init__(self, name):
        path, patience = os.path.join("/dev/shm", name), time.monotonic() + 20
        while True:
            try:
                with open(path, "r+b") as file:
                    self.map = mmap.mmap(file.fileno(), 0)
                if self.map[:8] == b"sslpshm1":
                    break
            except (FileNotFoundError, ValueError):
                pass
            assert time.monotonic() < patience, f"{path}: nobody there"
            time.sleep(0.01)
        self.words = memoryview(self.map).cast("Q")  # a store to an item is one store of 8 bytes
        self.inputs, self.outputs = self.word(32), self.word(40)
        self.length, self.seen = HEAD.size + 8 * self.word(24), 0

    def word(self, place):
        return self.words[place // 8]

    def receive(self):
        while True:
            counter = self.word(self.outputs)
            if counter != self.seen and counter % 2 == 0:
                packet = self.map[self.outputs + 16:self.outputs + 16 + self.length]
                if self.word(self.outputs) == counter:
                    self.seen = counter
                    return packet
            if self.word(56) == 2:  # the loop is over
                return None
            time.sleep(20e-6)

    def send(self, packet):
        busy = self.word(self.inputs) | 1
        self.words[self.inputs // 8] = busy
        self.map[self.inputs + 8:self.inputs + 16 + len(packet)] = struct.pack("<Q", os.getpid()) + packet
        self.words[self.inputs // 8] = busy + 1


def target(t):
    """Half of the time a triangle of ±5 um at 10 Hz, half of the time steps to 2 um and 5 um, m."""
    t %= 0.4
    if t < 0.2:
        phase = 10.0 * t % 1.0
        return 5e-6 * (4 * phase if phase < 0.25 else 2 - 4 * phase if phase < 0.75 else 4 * phase - 4)
    return 2e-6 if t < 0.3 else 5e-6


LARGEST, SLOWEST, FASTEST, LOST = 400e-9, 500.0, 1000.0, 37e-9  # stroke, m; frequencies, Hz; what a flyback takes back, m


def cycles(speed):
    """Cycles that carry the stage at a speed (m/s): by their frequency while strokes are full, below that by shorter strokes."""
    if speed == 0.0:
        return 0.0, SLOWEST, 1.0
    heading, speed = math.copysign(1.0, speed), abs(speed)
    frequency = min(max(speed / (LARGEST - LOST), SLOWEST), FASTEST)
    return min(LOST + speed / frequency, LARGEST), frequency, heading


def main():
    if len(sys.argv) != {"udp": 5, "shm": 3}.get(sys.argv[1] if len(sys.argv) > 1 else ""):
        sys.exit("usage: client.py udp HOST PORT-OF-THE-LOOP OWN-PORT, or client.py shm NAME")
    link = Udp(*sys.argv[2:5]) if sys.argv[1] == "udp" else Memory(sys.argv[2])
    proportional, integral, near = 300.0, 50000.0, 2e-9  # 1/s; 1/s²; m
    total, last, answers, squares = 0.0, 0.0, 0, 0.0
    while (packet := link.receive()) is not None:
        scenario, sequence, t, (x, *_) = unpack(packet)
        goal = target(t)
        error = goal - x
        stands, is_close = target(t - 1e-3) == goal, abs(error) < LARGEST
        rests = stands and abs(error) < near
        waits = stands and is_close and t % 4e-3 < 3e-3
        total = 0.0 if rests else max(-4e-10, min(4e-10, total + (not waits) * error * min(t - last, 1e-3)))
        last, answers, squares = t, answers + 1, squares + error * error
        ahead = (goal - target(t - 1e-3)) / 1e-3 if t % 0.4 < 0.2 else 0.0  # the scan's own speed
        speed = 0.0 if rests else ahead + proportional * error + integral * total
        # Close to its goal one cycle at a time, each from rest: a number of steps counts when it changes.
        steps = (0.0 if waits else 1.0) if stands and is_close else -1.0
        link.send(pack(scenario, answers, t, (*cycles(speed), steps, goal, error)))
    print(f"{answers} answers up to {last:.4f} s, error {1e9 * math.sqrt(squares / max(answers, 1)):.1f} nm rms")


main()
