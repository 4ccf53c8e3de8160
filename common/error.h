#pragma once

#include <stdexcept>

namespace nao {

/** Something failed while starting up. The text says what, where, and what to try. */
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/** A command line option or a configuration file is wrong. */
struct ConfigError : Error {
  using Error::Error;
};

/** A robot file (URDF, mesh, posture, ...) is missing or wrong. */
struct ModelError : Error {
  using Error::Error;
};

/** The message bus cannot be used. */
struct BusError : Error {
  using Error::Error;
};

}  // namespace nao
