#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <naolcm/body_state_t.hpp>
#include <naolcm/daemon_status_t.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "common/json_writer.h"
#include "common/wall_clock.h"
#include "messages/body_condition.h"
#include "tools/nao/subcommand.h"
#include "tools/nao/text_table.h"

namespace nao {
namespace {

/** Resources used by a process of this host. */
struct ProcessUsage {
  /** CPU time on all cores, s. */
  double cpu_seconds = 0;
  /** Resident memory, bytes. */
  double memory_bytes = 0;
};

/** Reads /proc. @return nullopt if there is no such process. */
std::optional<ProcessUsage> read_process_usage(int process_id) {
  std::ifstream file("/proc/" + std::to_string(process_id) + "/stat");
  const std::string line((std::istreambuf_iterator<char>(file)), {});
  // Source: proc(5). Field 2 is the program's name in parentheses and may contain spaces. The rest
  // begins with field 3; utime is field 14, stime 15, rss 24.
  const size_t name_end = line.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream fields(line.substr(name_end + 1));
  std::string field;
  double ticks = 0;
  ProcessUsage usage;
  for (int number = 3; number <= 24 && fields >> field; ++number) {
    if (number == 14 || number == 15) ticks += std::stod(field);
    if (number == 24) {
      usage.memory_bytes = std::stod(field) * static_cast<double>(sysconf(_SC_PAGESIZE));
    }
  }
  usage.cpu_seconds = ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
  return usage;
}

/** Listening time, s: every program publishes once a second, so each is received at least once. */
constexpr double kStatusListenTime = 1.3;

/** Age of a status beyond which its program has ended, s; see daemon_status_t. */
constexpr double kSilence = 3.0;

/** One running program. */
struct ProgramReport {
  naolcm::daemon_status_t status;
  /** When it was received, s. */
  double time = 0;
  /** Usage at the first status and its time, s. Only for programs on this host. */
  std::optional<ProcessUsage> first_usage;
  double first_time = 0;
};

class StatusListener {
 public:
  explicit StatusListener(const CommonOptions& common)
      : bus_(common.lcm_url), robot_(common.robot) {
    bus_.subscribe<naolcm::body_state_t>(RobotChannels(robot_).body_state, Bus::Queue::kLatest,
                                         [this](const auto& body) { body_ = body; });
    std::array<char, 256> host{};
    if (gethostname(host.data(), host.size() - 1) == 0) host_ = host.data();
    bus_.subscribe<naolcm::daemon_status_t>(
        kDaemonStatusChannel, Bus::Queue::kAll, [this](const auto& status) {
          const auto [entry, is_new] =
              programs_.try_emplace({status.program, status.host, status.process_id});
          entry->second.status = status;
          entry->second.time = monotonic_seconds();
          if (is_new && status.host == host_) {
            entry->second.first_usage = read_process_usage(status.process_id);
            entry->second.first_time = monotonic_seconds();
          }
        });
    loop_.on_readable(bus_.descriptor(), [this] { bus_.handle(); });
  }

  EventLoop& loop() { return loop_; }

  /** Programs of other hosts do not count from now on. */
  void keep_to_this_host() { is_this_host_only_ = true; }

  /** @return Newest status of the program of that name; nullptr if none was received. */
  const naolcm::daemon_status_t* find(const std::string& program) const {
    const naolcm::daemon_status_t* newest = nullptr;
    for (const auto& [key, report] : programs_) {
      if (is(report, program) &&
          (newest == nullptr || report.status.wall_utime > newest->wall_utime)) {
        newest = &report.status;
      }
    }
    return newest;
  }

  /** @return Number of processes of the program that are ready. */
  int count_ready(const std::string& program) const {
    const double now = monotonic_seconds();
    return static_cast<int>(
        std::count_if(programs_.begin(), programs_.end(), [&](const auto& entry) {
          const ProgramReport& report = entry.second;
          return is(report, program) && report.status.state == "ready" &&
                 now - report.time < kSilence;
        }));
  }

  std::string to_text() const {
    std::vector<std::vector<std::string>> rows{{"program", "robot", "host", "process", "state",
                                                "loop Hz", "worst ms", "in", "out", "dropped",
                                                "cpu %", "memory MB", "detail"}};
    for (const auto& [key, report] : programs_) {
      const naolcm::daemon_status_t& status = report.status;
      const auto [cpu, memory] = usage_of(report);
      rows.push_back(
          {status.program, status.robot, status.host, std::to_string(status.process_id),
           status.state, rate_text(status), format_number(status.loop_period_worst * 1000, 1),
           std::to_string(status.num_messages_in), std::to_string(status.num_messages_out),
           std::to_string(status.num_messages_dropped), format_number(cpu, 0),
           format_number(memory / 1e6, 0), status.detail});
    }
    std::string text = format_table(rows);
    if (body_) {
      const BodyCondition condition = summarize(*body_);
      if (condition.is_known()) text += robot_ + ": " + to_sentence(condition) + "\n";
    }
    return text;
  }

  std::string to_json() const {
    JsonWriter json;
    json.begin_array();
    for (const auto& [key, report] : programs_) {
      const naolcm::daemon_status_t& status = report.status;
      const auto [cpu, memory] = usage_of(report);
      json.begin_object();
      json.add("program", status.program);
      json.add("robot", status.robot);
      json.add("host", status.host);
      json.add("process_id", status.process_id);
      json.add("version", status.version);
      json.add("state", status.state);
      json.add("detail", status.detail);
      json.add("loop_period_mean", status.loop_period_mean);
      json.add("loop_period_worst", status.loop_period_worst);
      json.add("num_messages_in", status.num_messages_in);
      json.add("num_messages_out", status.num_messages_out);
      json.add("num_messages_dropped", status.num_messages_dropped);
      json.add("cpu_percent", cpu);
      json.add("memory_bytes", memory);
      json.begin_object("metrics");
      for (int i = 0; i < status.num_metrics; ++i) {
        json.add(status.metric_names[i], status.metric_values[i]);
      }
      json.end();
      json.end();
    }
    return json.take() + "\n";
  }

 private:
  bool is(const ProgramReport& report, const std::string& program) const {
    return report.status.program == program && (!is_this_host_only_ || report.status.host == host_);
  }

  static std::string rate_text(const naolcm::daemon_status_t& status) {
    return status.loop_period_mean > 0 ? format_number(1 / status.loop_period_mean, 0) : "-";
  }

  /** @return CPU usage since the first status, % of one core, and memory, bytes; NaN if unknown. */
  static std::pair<double, double> usage_of(const ProgramReport& report) {
    const auto usage = read_process_usage(report.status.process_id);
    const double duration = monotonic_seconds() - report.first_time;
    if (!report.first_usage || !usage || duration < 0.1) return {std::nan(""), std::nan("")};
    return {(usage->cpu_seconds - report.first_usage->cpu_seconds) / duration * 100,
            usage->memory_bytes};
  }

  EventLoop loop_;
  Bus bus_;
  std::string robot_;
  std::string host_;
  bool is_this_host_only_ = false;
  /** Newest one; simulated robots publish none. */
  std::optional<naolcm::body_state_t> body_;
  std::map<std::tuple<std::string, std::string, int>, ProgramReport> programs_;
};

/** Waits until every program says "ready", of a program that is named n times n processes.
 * @return The exit status. */
int wait_until_ready(StatusListener& listener, const std::vector<std::string>& wanted,
                     double timeout) {
  const double start = monotonic_seconds();
  std::map<std::string, int> num_wanted;
  for (const std::string& program : wanted) ++num_wanted[program];
  bool all_ready = false;
  listener.loop().every(0.02, [&] {
    all_ready = std::all_of(num_wanted.begin(), num_wanted.end(), [&](const auto& entry) {
      return listener.count_ready(entry.first) >= entry.second;
    });
    if (all_ready || monotonic_seconds() - start > timeout) listener.loop().stop("end");
  });
  listener.loop().run();
  if (all_ready) return 0;
  for (const auto& [program, count] : num_wanted) {
    const int num_ready = listener.count_ready(program);
    if (num_ready >= count) continue;
    const auto* status = listener.find(program);
    const std::string number =
        count > 1 ? std::to_string(num_ready) + " of " + std::to_string(count) + ", newest: " : "";
    std::fprintf(stderr, "nao: %s is not ready: %s%s\n", program.c_str(), number.c_str(),
                 status == nullptr ? "it publishes no status"
                                   : (status->state + ", " + status->detail).c_str());
  }
  return 1;
}

int run_status(const CommonOptions& common, const std::vector<std::string>& wanted,
               bool is_this_host_only, double timeout, bool as_json) {
  StatusListener listener(common);
  if (is_this_host_only) listener.keep_to_this_host();
  if (!wanted.empty()) return wait_until_ready(listener, wanted, timeout);
  listener.loop().every(kStatusListenTime, [&listener] { listener.loop().stop("end"); });
  listener.loop().run();
  std::fputs((as_json ? listener.to_json() : listener.to_text()).c_str(), stdout);
  return 0;
}

}  // namespace

void add_status_command(CommandLine& app, Invocation& invocation) {
  auto wanted = std::make_shared<std::vector<std::string>>();
  auto timeout = std::make_shared<double>(30);
  auto is_this_host_only = std::make_shared<bool>(false);
  auto as_json = std::make_shared<bool>(false);
  CommandLine* status = app.add_subcommand("status", "List the programs on the bus, on every host");
  status->add_flag("--json", *as_json, "As JSON, fields as in daemon_status_t");
  status
      ->add_option("--wait", *wanted,
                   "List nothing; wait until these programs are ready: nao-sim,nao-motion; named "
                   "twice: two processes of it")
      ->separated_by(',');
  status->add_flag("--this-host", *is_this_host_only,
                   "With --wait: only programs of this host count");
  status->add_option("--timeout", *timeout, "Longest wait, s")->positive();
  invocation.on(*status, [wanted, is_this_host_only, timeout, as_json](const auto& common) {
    return run_status(common, *wanted, *is_this_host_only, *timeout, *as_json);
  });
}

}  // namespace nao
