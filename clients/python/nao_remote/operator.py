"""The operator's console (PROTOCOL.md, section 9): from the gateway's own host only."""

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

    async def take_control(self) -> None:
        """Takes control from every client until release_control(), also after this connection has ended."""
        await self._operate(pb.Operate.TAKE)

    async def release_control(self) -> None:
        """Lets clients drive again."""
        await self._operate(pb.Operate.RELEASE)

    async def kick(self, client_id: int) -> None:
        """Closes a client's connection."""
        await self._operate(pb.Operate.KICK, client_id)

    async def _operate(self, operation: pb.Operate.Operation, client_id: int = 0) -> pb.Response:
        return await self._connection.request(operate=pb.Operate(operation=operation, client_id=client_id))
