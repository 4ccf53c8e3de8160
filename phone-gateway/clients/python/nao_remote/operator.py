"""The operator's console (PROTOCOL.md, section 10): from the gateway's own host only."""

from __future__ import annotations

from nao_remote import remote_pb2 as pb
from nao_remote.connection import Connection
from nao_remote.messages import Client


class Operator:
    """All methods raise NotAllowed on another host."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    async def clients(self) -> list[Client]:
        """@return the gateway's clients."""
        response = await self._operate(pb.Operate.LIST)
        return [Client.from_protocol(client) for client in response.clients.clients]

    async def take_control(self, robot: str = "") -> None:
        """Takes control from every client until release_control(), also after this connection has ended.

        @param robot  One of several robots; empty: all.
        """
        await self._operate(pb.Operate.TAKE, robot=robot)

    async def release_control(self, robot: str = "") -> None:
        """Lets clients drive again. @param robot  One of several robots; empty: all."""
        await self._operate(pb.Operate.RELEASE, robot=robot)

    async def kick(self, client_id: int) -> None:
        """Closes a client's connection."""
        await self._operate(pb.Operate.KICK, client_id)

    async def mute(self, client_id: int) -> None:
        """Lets a client watch only, until unmute() or the end of its connection."""
        await self._operate(pb.Operate.MUTE, client_id)

    async def unmute(self, client_id: int) -> None:
        """Lets a client drive again."""
        await self._operate(pb.Operate.UNMUTE, client_id)

    async def assign(self, client_id: int, robot: str = "") -> None:
        """Lets a client drive a robot, also if another client drove it before. @param robot  Empty: the one that it watches."""
        await self._operate(pb.Operate.ASSIGN, client_id, robot)

    async def _operate(self, operation: pb.Operate.Operation, client_id: int = 0, robot: str = "") -> pb.Response:
        return await self._connection.request(operate=pb.Operate(operation=operation, client_id=client_id, robot=robot))
