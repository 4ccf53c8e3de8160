#!/usr/bin/python3
"""Addresses and tokens."""

import os
import random
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import built_package  # noqa: F401
from nao_remote import discovery
from nao_remote.address import Address, resolve


class Addresses(unittest.TestCase):
    def test_hosts_and_urls_are_read(self):
        for text, expected in {
                "nao.local": Address("nao.local", 8080, "ws"),
                "nao.local:81": Address("nao.local", 81, "ws"),
                " 192.168.1.20 ": Address("192.168.1.20", 8080, "ws"),
                "[fe80::1]:8080": Address("fe80::1", 8080, "ws"),
                "http://nao.local:8080/#token=k7": Address("nao.local", 8080, "ws", "k7"),
                "https://nao.local/#token=k7": Address("nao.local", 8080, "wss", "k7"),
                "wss://nao.local:443": Address("nao.local", 443, "wss"),
                "ws://nao.local": Address("nao.local", 8080, "ws"),
                "tcp://nao.local": Address("nao.local", 7668, "tcp"),
                "tcp://nao.local:99#token=a%20b": Address("nao.local", 99, "tcp", "a b")}.items():
            self.assertEqual(Address.parse(text), expected, text)

    def test_others_are_refused_by_name(self):
        for text in ("", "ftp://nao.local", "http://", "nao.local:port", "nao.local:99999", "http://[::1", ":8080"):
            with self.assertRaises(ValueError, msg=text):
                Address.parse(text)

    def test_any_text_is_read_or_refused(self):
        numbers = random.Random(1)
        for _ in range(3000):
            text = "".join(numbers.choice("aé:/[]#=%@?. \t\n09-wstpch") for _ in range(numbers.randrange(20)))
            try:
                parsed = Address.parse(text)
            except ValueError:
                continue
            self.assertTrue(parsed.host and 0 < parsed.port < 65536, text)

    def test_an_address_is_shown_without_its_token(self):
        address = Address.parse("http://[fe80::1]/#token=k7")
        self.assertEqual(str(address), "ws://[fe80::1]:8080")
        self.assertEqual(address.websocket_url, "ws://[fe80::1]:8080/ws")

    def test_the_token_comes_from_the_nearest_source(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(os.environ, {"NAO_REMOTE_TOKEN": "environment"}):
            file = Path(folder) / "token"
            file.write_text("file\nmore\n")
            url = "http://nao.local/#token=url"
            self.assertEqual(resolve(url, "argument", file).token, "argument")
            self.assertEqual(resolve(url, None, file).token, "file")
            self.assertEqual(resolve(url).token, "url")
            self.assertEqual(resolve("nao.local").token, "environment")
            self.assertEqual(resolve(url, "").token, "")
        with mock.patch.dict(os.environ, clear=True):
            self.assertEqual(resolve("nao.local").token, "")

    def test_without_an_address_no_robot_of_the_network_is_taken(self):
        with mock.patch.dict(os.environ, clear=True), mock.patch.object(discovery, "from_network", lambda timeout: ["http://b"]):
            self.assertEqual(discovery.first_address(), "localhost")

    def test_finders_are_asked_in_order(self):
        with mock.patch.dict(os.environ, {"NAO_REMOTE_URL": "http://a"}), \
                mock.patch.object(discovery, "FINDERS", [discovery.from_environment, lambda timeout: ["http://b", "http://a"]]):
            self.assertEqual(discovery.discover(), ["http://a", "http://b"])
            self.assertEqual(discovery.first_address(), "http://a")
        with mock.patch.dict(os.environ, clear=True), mock.patch.object(discovery, "FINDERS", [discovery.from_environment]):
            self.assertEqual(discovery.discover(), [])
            self.assertEqual(discovery.first_address(), "localhost")


if __name__ == "__main__":
    unittest.main()
