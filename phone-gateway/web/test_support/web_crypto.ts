/** Node 18 has the browsers' `crypto` in a module only. */
import {webcrypto} from "node:crypto";

globalThis.crypto ??= webcrypto as Crypto;
