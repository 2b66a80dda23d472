"""The network between navigation and the robot."""

import select
import socket
import threading


class Proxy(threading.Thread):
    """Passes bytes on between navigation and the robot, until it is told not to."""

    def __init__(self, robot_port):
        super().__init__(daemon=True)
        self.robot_port = robot_port
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        self.pairs = {}
        self.is_cut = self.is_silent = self.is_over = False

    def run(self):
        while not self.is_over:
            if self.is_cut:
                self.close_all()
            watched = [self.listener] + ([] if self.is_silent else list(self.pairs))
            for ready in select.select(watched, [], [], 0.005)[0]:
                if ready is self.listener:
                    self.accept()
                elif ready in self.pairs:
                    self.pass_on(ready)
        self.close_all()
        self.listener.close()

    def accept(self):
        client, _ = self.listener.accept()
        try:
            if self.is_cut:
                raise OSError
            robot = socket.create_connection(("127.0.0.1", self.robot_port), timeout=1)
        except OSError:
            client.close()
            return
        for one in (client, robot):
            one.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.pairs[client], self.pairs[robot] = robot, client

    def pass_on(self, one):
        try:
            data = one.recv(1 << 16)
            if data:
                self.pairs[one].sendall(data)
                return
        except OSError:
            pass
        self.close(one)

    def close(self, one):
        other = self.pairs.pop(one, None)
        self.pairs.pop(other, None)
        one.close()
        if other:
            other.close()

    def close_all(self):
        for one in list(self.pairs):
            self.close(one)
