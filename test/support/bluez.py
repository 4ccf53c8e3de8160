#!/usr/bin/python3
"""Usage: bluez.py [--no-adapter]

Stands for bluetoothd on the system bus of DBUS_SYSTEM_BUS_ADDRESS, with one adapter, and for phones within reach. One JSON object a
line: on stdin what a phone does, on stdout its results, by the same "id", and events.

  {"id": 1, "do": "read", "phone": "AA", "mtu": 185}       -> {"id": 1, "value": HEX} or {"id": 1, "error": TEXT}
  {"id": 2, "do": "write", "phone": "AA", "mtu": 185, "value": HEX}
  {"id": 3, "do": "start" or "stop"}                        asks for notifications, or for none any more
  {"id": 4, "do": "leave", "phone": "AA"}                   is out of reach
  {"event": "advertised", "name": NAME, "services": [UUID], "characteristics": [UUID]}
  {"event": "value", "value": HEX}                          a notification
"""

import json
import os
import sys

import dbus
import dbus.service
from dbus.mainloop.glib import DBusGMainLoop
from gi.repository import GLib

ADAPTER = "/org/bluez/hci0"
OBJECTS = "org.freedesktop.DBus.ObjectManager"
PROPERTIES = "org.freedesktop.DBus.Properties"
CHARACTERISTIC = "org.bluez.GattCharacteristic1"


def tell(**what):
    print(json.dumps(what), flush=True)


def path_of(phone):
    return dbus.ObjectPath(f"{ADAPTER}/dev_{phone}")


class Root(dbus.service.Object):
    def __init__(self, bus, has_adapter):
        super().__init__(bus, "/")
        self.has_adapter = has_adapter

    @dbus.service.method(OBJECTS, out_signature="a{oa{sa{sv}}}")
    def GetManagedObjects(self):
        nothing = dbus.Dictionary({}, signature="sv")
        names = ["org.bluez.Adapter1", "org.bluez.GattManager1", "org.bluez.LEAdvertisingManager1"]
        adapter = {dbus.ObjectPath(ADAPTER): {name: nothing for name in names}} if self.has_adapter else {}
        return dbus.Dictionary({dbus.ObjectPath("/org/bluez"): {"org.bluez.AgentManager1": nothing}, **adapter}, signature="oa{sa{sv}}")


class Device(dbus.service.Object):
    @dbus.service.signal(PROPERTIES, signature="sa{sv}as")
    def PropertiesChanged(self, interface, changed, invalidated):
        pass


class Adapter(dbus.service.Object):
    """The adapter, with the application of one client."""

    def __init__(self, bus):
        super().__init__(bus, ADAPTER)
        self.bus = bus
        self.devices = {}
        self.services = []
        self.characteristics = {}  # UUID: proxy

    @dbus.service.method(PROPERTIES, in_signature="ssv")
    def Set(self, interface, name, value):
        assert (interface, name, bool(value)) == ("org.bluez.Adapter1", "Powered", True)

    @dbus.service.method("org.bluez.GattManager1", in_signature="oa{sv}", sender_keyword="sender", async_callbacks=("reply", "fail"))
    def RegisterApplication(self, path, _options, reply, fail, sender=None):
        def found(objects):
            for path, interfaces in objects.items():
                if service := interfaces.get("org.bluez.GattService1"):
                    assert service["Primary"]
                    self.services.append(str(service["UUID"]))
                if characteristic := interfaces.get(CHARACTERISTIC):
                    assert characteristic["Service"] in objects
                    assert sorted(characteristic["Flags"]) == ["notify", "read", "write-without-response"]
                    self.characteristics[str(characteristic["UUID"])] = self.bus.get_object(sender, path, introspect=False)
                    self.bus.add_signal_receiver(self.changed, "PropertiesChanged", PROPERTIES, sender, path)
            reply()

        self.services, self.characteristics = [], {}
        self.bus.get_object(sender, path, introspect=False).GetManagedObjects(
            dbus_interface=OBJECTS, reply_handler=found, error_handler=fail)

    @dbus.service.method("org.bluez.LEAdvertisingManager1", in_signature="oa{sv}", sender_keyword="sender",
                         async_callbacks=("reply", "fail"))
    def RegisterAdvertisement(self, path, _options, reply, fail, sender=None):
        def found(properties):
            assert list(properties["ServiceUUIDs"]) == self.services and properties["Type"] == "peripheral"
            tell(event="advertised", name=str(properties["LocalName"]), services=self.services,
                 characteristics=list(self.characteristics))
            reply()

        self.bus.get_object(sender, path, introspect=False).GetAll(
            "org.bluez.LEAdvertisement1", dbus_interface=PROPERTIES, reply_handler=found, error_handler=fail)

    def changed(self, interface, values, _invalidated):
        if interface == CHARACTERISTIC and "Value" in values:
            tell(event="value", value=bytes(values["Value"]).hex())

    def act(self, id, do, phone="", mtu=23, value=""):
        [characteristic] = self.characteristics.values()
        options = dbus.Dictionary({"device": path_of(phone), "mtu": dbus.UInt16(mtu)}, signature="sv")
        handlers = {"dbus_interface": CHARACTERISTIC,
                    "reply_handler": lambda *found: tell(id=id, value=bytes(found[0]).hex() if found else ""),
                    "error_handler": lambda error: tell(id=id, error=error.get_dbus_message())}
        if do == "read":
            characteristic.ReadValue(options, **handlers)
        elif do == "write":
            characteristic.WriteValue(dbus.ByteArray(bytes.fromhex(value)), options, **handlers)
        elif do == "start":
            characteristic.StartNotify(**handlers)
        elif do == "stop":
            characteristic.StopNotify(**handlers)
        elif do == "leave":
            path = path_of(phone)
            if path not in self.devices:
                self.devices[path] = Device(self.bus, path)
            self.devices[path].PropertiesChanged("org.bluez.Device1", {"Connected": False}, [])
            tell(id=id, value="")


def main():
    DBusGMainLoop(set_as_default=True)
    bus = dbus.SystemBus()
    loop = GLib.MainLoop()
    Root(bus, "--no-adapter" not in sys.argv)
    adapter = Adapter(bus)
    name = dbus.service.BusName("org.bluez", bus)

    lines = bytearray()

    def read(_source, _condition):
        received = os.read(0, 65536)
        if not received:
            loop.quit()
            return False
        lines.extend(received)
        while (end := lines.find(b"\n")) >= 0:
            adapter.act(**json.loads(lines[:end]))
            del lines[:end + 1]
        return True

    GLib.io_add_watch(0, GLib.IO_IN | GLib.IO_HUP, read)
    tell(event="ready")
    loop.run()
    del name


if __name__ == "__main__":
    main()
