// Measures what a driver sees over bad links: stack and phone in network namespaces of their own,
// joined by an emulated link.

#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "common/scheduling.h"
#include "tools/bench/link_phone.h"
#include "tools/bench/run_benchmark.h"

namespace nao::bench {
namespace {

struct Row {
  LinkConditions conditions;
  uint32_t image_width = 320;
};

Row make_row(const std::string& name, double loss, double delay) {
  Row row;
  row.conditions.name = name;
  row.conditions.loss = loss;
  row.conditions.delay = delay;
  return row;
}

std::vector<Row> make_rows() {
  std::vector<Row> rows = {make_row("clean", 0, 0),    make_row("loss5", 0.05, 0),
                           make_row("loss10", 0.1, 0), make_row("delay100_loss2", 0.02, 0.1),
                           make_row("pauses", 0, 0),   make_row("1mbit_large", 0, 0)};
  rows[4].conditions.pause = 0.8;
  rows[4].conditions.pause_period = 10;
  rows[5].conditions.rate = 1e6 / 8;
  rows[5].image_width = 640;
  return rows;
}

void add_figures(const std::string& link, const DrivenTime& seen, double time,
                 std::vector<Figure>& figures) {
  const auto add = [&](const std::string& name, double value, const std::string& unit) {
    figures.push_back({"links." + link + "." + name, value, unit, "", 0});
  };
  add("ends_per_min", seen.num_ends * 60 / time, "1/min");
  add("halts_per_min", seen.num_halts * 60 / time, "1/min");
  add("state_age_ms.p50", percentile(seen.state_age_ms, 0.5), "ms");
  add("state_age_ms.p95", percentile(seen.state_age_ms, 0.95), "ms");
  add("image_age_ms.p95", percentile(seen.image_age_ms, 0.95), "ms");
  add("image_shown_age_ms.p95", percentile(seen.shown_age_ms, 0.95), "ms");
  add("answer_ms.p95", percentile(seen.answer_ms, 0.95), "ms");
  add("answer_ms.p99", percentile(seen.answer_ms, 0.99), "ms");
  add("answer_ms.max", percentile(seen.answer_ms, 1), "ms");
  add("old_commands", seen.num_old_commands, "");
  add("lost_connections", seen.num_lost_connections, "");
  add("states_per_s", static_cast<double>(seen.state_age_ms.size()) / time, "1/s");
  add("images_per_s", static_cast<double>(seen.image_age_ms.size()) / time, "1/s");
  add("image_kb",
      seen.image_bytes / 1e3 / std::max<double>(1, static_cast<double>(seen.image_age_ms.size())),
      "kB");
}

std::vector<Figure> run(const std::vector<std::string>& only, double time, uint32_t seed,
                        const std::string& congestion, bool has_second) {
  EmulatedLink link;
  GatewayStack stack("udpm://239.255.76.67:7667?ttl=0",
                     {"--http-port", "8080", "--tcp-port", "0", "--token", GatewayStack::kToken,
                      "--no-announce", "--tcp-congestion", congestion});
  LinkPhone phone(stack, link, has_second);
  std::vector<Figure> figures;
  for (const Row& row : make_rows()) {
    const std::string& name = row.conditions.name;
    if (!only.empty() && std::find(only.begin(), only.end(), name) == only.end()) continue;
    std::cerr << "link " << name << " ..." << std::endl;
    link.set(row.conditions, seed);
    add_figures(name, phone.drive(time, row.image_width), time, figures);
  }
  return figures;
}

}  // namespace
}  // namespace nao::bench

int main(int argc, char** argv) {
  nao::CommandLine app("Measures driving a simulated robot over bad links", "nao-bench-links");
  std::vector<std::string> only;
  std::vector<std::string> names;
  for (const auto& row : nao::bench::make_rows()) names.push_back(row.conditions.name);
  double time = 60;
  int seed = 1;
  app.add_option("--link", only, "Only these links; may be repeated")->one_of(names);
  app.add_option("--time", time, "How long the phone drives over each link, s")->range(1.0, 3600.0);
  std::string congestion = "cubic";
  bool has_second = true;
  app.add_option("--tcp-congestion", congestion, "Of the gateway; the phone has cubic");
  app.add_flag("!--one-connection", has_second, "The phone opens no second connection");
  app.add_option("--seed", seed, "Of the links' losses")->not_negative();
  return nao::run_benchmark(app, argc, argv, [&] {
    // The link and the phone are machines of their own: they must not wait for this one's
    // processor.
    nao::request_realtime_scheduling(nao::RealtimePriority::kControl);
    return nao::bench::run(only, time, static_cast<uint32_t>(seed), congestion, has_second);
  });
}
