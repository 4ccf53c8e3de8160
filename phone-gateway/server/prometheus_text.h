#pragma once

#include <sstream>
#include <string>

namespace nao {

/** Figures as Prometheus reads them: text exposition format, version 0.0.4
 * (https://prometheus.io/docs/instrumenting/exposition_formats). */
class PrometheusText {
 public:
  PrometheusText() { text_.precision(15); }

  /** The samples that follow belong to this figure.
   * @param name  Snake case with its unit; one that only grows ends in _total. */
  void begin(const std::string& name, const std::string& help) {
    name_ = "nao_gateway_" + name;
    const bool only_grows = name.size() > 6 && name.compare(name.size() - 6, 6, "_total") == 0;
    text_ << "# HELP " << name_ << " " << help << "\n"
          << "# TYPE " << name_ << " " << (only_grows ? "counter" : "gauge") << "\n";
  }

  /** @param labels  {client="3"} or nothing; values without quote, backslash or line end. */
  void add(double value, const std::string& labels = "") {
    text_ << name_ << labels << " " << value << "\n";
  }

  std::string text() const { return text_.str(); }

 private:
  std::string name_;
  std::ostringstream text_;
};

}  // namespace nao
