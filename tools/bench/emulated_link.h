#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "tools/bench/link_model.h"

namespace nao::bench {

/** Two hosts on this machine, in network namespaces of their own, joined by an emulated link: a
 * tunnel device in each, and a thread that passes packets from one to the other as LinkModel says.
 * Needs no netem, which some kernels lack.
 *
 * The calling thread, and the programs that it starts, are on the first host from the constructor
 * on. */
class EmulatedLink {
 public:
  static constexpr const char* kHereAddress = "10.78.0.1";
  static constexpr const char* kThereAddress = "10.78.0.2";

  /** To be called while the process has one thread.
   * @throws std::runtime_error  where the system permits no namespaces or tunnel devices. */
  EmulatedLink();
  ~EmulatedLink();
  EmulatedLink(const EmulatedLink&) = delete;
  EmulatedLink& operator=(const EmulatedLink&) = delete;

  /** Sets conditions, a clean link at first. Packets under way are lost. @param seed  Of the
   * losses; both directions differ. */
  void set(const LinkConditions& conditions, uint32_t seed);

  /** Calls a function whose sockets belong to the other host. */
  void on_other_host(const std::function<void()>& act) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nao::bench
