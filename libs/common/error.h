#pragma once

#include <stdexcept>

namespace nao {

/** Failure of a program. The text states what failed, where, and what to do. */
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/** A command-line option or a configuration file is invalid. */
struct ConfigError : Error {
  using Error::Error;
};

/** A robot file (URDF, mesh, posture, ...) is missing or invalid. */
struct ModelError : Error {
  using Error::Error;
};

/** A received message cannot be decoded, or its content is invalid: it is dropped. The text states
 * what is wrong with it. */
struct MessageError : Error {
  using Error::Error;
};

/** The message bus is unavailable. */
struct BusError : Error {
  using Error::Error;
};

}  // namespace nao
