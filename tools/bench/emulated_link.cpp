#include "tools/bench/emulated_link.h"

#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <deque>
#include <fstream>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include "common/child_process.h"
#include "common/wall_clock.h"

namespace nao::bench {
namespace {

/** Packets under way in one direction; more are lost. Chosen: 1 s of the fastest row's traffic. */
constexpr size_t kMaxPackets = 4000;
/** How long the thread waits at most for a packet, s: it notices the end then. */
constexpr double kMaxWait = 0.1;

std::runtime_error system_error(const std::string& what) {
  return std::runtime_error("emulated link: " + what + ": " + std::strerror(errno) +
                            " (it needs root or user namespaces, and /dev/net/tun)");
}

void write_file(const std::string& name, const std::string& text) {
  std::ofstream file(name);
  file << text << std::flush;
  if (!file) throw system_error("cannot write " + name);
}

void ip(const std::string& words) {
  ChildProcess child({"/bin/sh", "-c", "PATH=$PATH:/usr/sbin:/sbin exec ip " + words});
  if (child.wait() != 0) throw std::runtime_error("ip " + words + ": " + child.output());
}

int open_namespace() {
  const int descriptor = open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw system_error("no network namespace");
  return descriptor;
}

void enter(int network) {
  if (setns(network, CLONE_NEWNET) != 0) throw system_error("setns");
}

/** A new namespace with one end of the link. @return Its descriptor. */
int make_host(const std::string& address, int& tunnel) {
  if (unshare(CLONE_NEWNET) != 0) throw system_error("unshare");
  ip("link set lo up multicast on");
  // The bus of the programs on this host.
  ip("route add 224.0.0.0/4 dev lo");
  tunnel = open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (tunnel < 0) throw system_error("/dev/net/tun");
  ifreq request{};
  std::strncpy(request.ifr_name, "tunnel", IFNAMSIZ - 1);
  request.ifr_flags = IFF_TUN | IFF_NO_PI;
  if (ioctl(tunnel, TUNSETIFF, &request) != 0) throw system_error("TUNSETIFF");
  ip("address add " + address + "/24 dev tunnel");
  ip("link set tunnel up");
  return open_namespace();
}

/** Root has the right to make namespaces; another user gets it in a user namespace. */
void become_root() {
  if (geteuid() == 0) return;
  const std::string user = std::to_string(geteuid());
  const std::string group = std::to_string(getegid());
  if (unshare(CLONE_NEWUSER) != 0) throw system_error("unshare");
  write_file("/proc/self/uid_map", "0 " + user + " 1");
  write_file("/proc/self/setgroups", "deny");
  write_file("/proc/self/gid_map", "0 " + group + " 1");
}

}  // namespace

/** Packets under way in one direction. */
class Direction {
 public:
  Direction(int from, int to) : from_(from), to_(to) {}

  void set(const LinkConditions& conditions, uint32_t seed, double now) {
    model_ = LinkModel(conditions, seed, now);
    packets_.clear();
  }

  /** Takes all packets that were sent, and delivers those that are due. */
  void step(double now) {
    std::array<char, 65536> bytes;
    for (ssize_t size = 0; (size = read(from_, bytes.data(), bytes.size())) > 0;) {
      const auto arrival = model_.send(static_cast<size_t>(size), now);
      if (!arrival || packets_.size() >= kMaxPackets) continue;
      packets_.push_back({*arrival, std::string(bytes.data(), static_cast<size_t>(size))});
    }
    while (!packets_.empty() && packets_.front().arrival <= now) {
      // A host that takes no more loses the packet, as any host does.
      const std::string& packet = packets_.front().bytes;
      [[maybe_unused]] const ssize_t written = write(to_, packet.data(), packet.size());
      packets_.pop_front();
    }
  }
  /** When the next packet is due, s; `latest` if that is earlier. */
  double next(double latest) const {
    return packets_.empty() ? latest : std::min(latest, packets_.front().arrival);
  }

 private:
  struct Packet {
    double arrival;
    std::string bytes;
  };
  int from_;
  int to_;
  LinkModel model_{{}, 0, 0};
  std::deque<Packet> packets_;
};

struct EmulatedLink::Impl {
  Impl() {
    become_root();
    there = make_host(kThereAddress, there_tunnel);
    here = make_host(kHereAddress, here_tunnel);
    directions = {{{there_tunnel, here_tunnel}, {here_tunnel, there_tunnel}}};
    thread = std::thread([this] { run(); });
  }
  ~Impl() {
    is_ending = true;
    thread.join();
    for (const int descriptor : {here, there, here_tunnel, there_tunnel}) close(descriptor);
  }

  void run() {
    // The default slack of timers, 50 us, would lengthen every delay.
    prctl(PR_SET_TIMERSLACK, 1);
    while (!is_ending) {
      const double before = monotonic_seconds();
      double next = before + kMaxWait;
      {
        const std::lock_guard lock(mutex);
        for (Direction& direction : directions) direction.step(before);
        for (const Direction& direction : directions) next = direction.next(next);
      }
      std::array<pollfd, 2> polled{{{here_tunnel, POLLIN, 0}, {there_tunnel, POLLIN, 0}}};
      const double wait = std::max(0.0, next - monotonic_seconds());
      const timespec time{0, static_cast<long>(wait * 1e9)};
      ppoll(polled.data(), polled.size(), &time, nullptr);
    }
  }

  int here = -1;
  int there = -1;
  int here_tunnel = -1;
  int there_tunnel = -1;
  std::mutex mutex;
  /** To this host and to the other one. */
  std::array<Direction, 2> directions{{{-1, -1}, {-1, -1}}};
  std::atomic<bool> is_ending = false;
  // Packets pass while the calling thread waits for answers to its own.
  std::thread thread;
};

EmulatedLink::EmulatedLink() : impl_(std::make_unique<Impl>()) {}
EmulatedLink::~EmulatedLink() = default;

void EmulatedLink::set(const LinkConditions& conditions, uint32_t seed) {
  const std::lock_guard lock(impl_->mutex);
  const double now = monotonic_seconds();
  impl_->directions[0].set(conditions, 2 * seed, now);
  impl_->directions[1].set(conditions, 2 * seed + 1, now);
}

void EmulatedLink::on_other_host(const std::function<void()>& act) const {
  enter(impl_->there);
  try {
    act();
  } catch (...) {
    enter(impl_->here);
    throw;
  }
  enter(impl_->here);
}

}  // namespace nao::bench
