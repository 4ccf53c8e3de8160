#pragma once

#include <sstream>
#include <string>
#include <utility>

namespace nao::gateway {

/** Metrics in Prometheus's text exposition format, version 0.0.4
 * (https://prometheus.io/docs/instrumenting/exposition_formats). */
class PrometheusText {
 public:
  /** @param prefix  Of all names. */
  explicit PrometheusText(std::string prefix = "nao_gateway_") : prefix_(std::move(prefix)) {
    // Counters stay exact up to 1e15.
    text_.precision(15);
  }

  /** Begins a metric; the samples that follow belong to it.
   * @param name  Snake case with its unit; a counter ends in _total. */
  void begin(const std::string& name, const std::string& help) {
    name_ = prefix_ + name;
    text_ << "# HELP " << name_ << " " << help << "\n"
          << "# TYPE " << name_ << " " << (name.ends_with("_total") ? "counter" : "gauge") << "\n";
  }

  /** Adds a sample. @param labels  {client="3"} or nothing; values without quotation mark,
   * backslash or line feed. */
  void add(double value, const std::string& labels = "") {
    text_ << name_ << labels << " " << value << "\n";
  }

  std::string text() const { return text_.str(); }

 private:
  std::string prefix_;
  std::string name_;
  std::ostringstream text_;
};

}  // namespace nao::gateway
