#include "test/playback/golden_trace.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "common/error.h"
#include "test/playback/golden_hash.h"

namespace nao::playback {
namespace {

std::string hexadecimal(uint64_t number) {
  std::ostringstream text;
  text << std::hex << std::setw(16) << std::setfill('0') << number;
  return text.str();
}

std::string quoted_or_none(const std::vector<std::string>& list, size_t index) {
  return index < list.size() ? "\"" + list[index] + "\"" : "nothing";
}

void compare_stream(const GoldenTrace& expected, const GoldenTrace& trace, size_t stream,
                    std::vector<std::string>& differences) {
  size_t num_different = 0;
  int64_t first = 0;
  for (const auto& [tick, hashes] : expected.hashes) {
    const auto found = trace.hashes.find(tick);
    if (found != trace.hashes.end() && found->second.at(stream) == hashes.at(stream)) continue;
    if (num_different == 0) first = tick;
    ++num_different;
  }
  if (num_different == 0) return;
  std::ostringstream text;
  text << expected.streams[stream] << ": " << num_different << " of " << expected.hashes.size()
       << " ticks differ, the first is tick " << first;
  differences.push_back(text.str());
}

}  // namespace

uint64_t hash_of_math_functions() {
  GoldenHash hash;
  for (int i = 1; i <= 2000; ++i) {
    const double x = 0.001234567 * i;       // up to about 2.5, as angles are
    const double ratio = x / 2.5;           // within the domain of asin() and acos()
    const double other = 1.7 - 0.9876 * x;  // of either sign
    for (const double y : {std::sin(x), std::cos(x), std::tan(x), std::asin(ratio),
                           std::acos(ratio), std::atan2(x, other), std::exp(other), std::log(x),
                           std::pow(x, 1.5), std::hypot(x, other), std::sinh(x), std::cosh(x)}) {
      hash.add(y);
    }
  }
  return hash.value();
}

void write_golden_trace(const std::filesystem::path& file, const GoldenTrace& trace) {
  std::ofstream stream(file);
  stream << "golden trace 1\nmath_functions " << hexadecimal(hash_of_math_functions())
         << "\nstreams";
  for (const std::string& name : trace.streams) stream << " " << name;
  stream << "\n";
  for (const std::string& result : trace.results) stream << "result " << result << "\n";
  for (const auto& [tick, hashes] : trace.hashes) {
    stream << tick;
    for (const uint64_t hash : hashes) stream << " " << hexadecimal(hash);
    stream << "\n";
  }
  stream.close();
  if (!stream) throw Error("cannot write " + file.string());
}

GoldenExpectation read_golden_trace(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line) || line != "golden trace 1") {
    throw Error(file.string() + " is missing or no golden trace");
  }
  GoldenExpectation expectation;
  GoldenTrace& trace = expectation.trace;
  while (std::getline(stream, line)) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "math_functions") {
      words >> std::hex >> expectation.math_functions;
    } else if (key == "streams") {
      for (std::string name; words >> name;) trace.streams.push_back(name);
    } else if (key == "result") {
      trace.results.push_back(line.substr(key.size() + 1));
    } else {
      std::vector<uint64_t>& hashes = trace.hashes[std::stoll(key)];
      for (uint64_t hash = 0; words >> std::hex >> hash;) hashes.push_back(hash);
      if (hashes.size() != trace.streams.size()) {
        throw Error(file.string() + " has a line that cannot be read: " + line);
      }
    }
  }
  return expectation;
}

std::vector<std::string> find_differences(const GoldenTrace& expected, const GoldenTrace& trace) {
  std::vector<std::string> differences;
  if (expected.streams != trace.streams) return {"the streams are not those expected"};
  for (size_t stream = 0; stream < expected.streams.size(); ++stream) {
    compare_stream(expected, trace, stream, differences);
  }
  for (const auto& [tick, hashes] : trace.hashes) {
    if (expected.hashes.contains(tick)) continue;
    differences.push_back("tick " + std::to_string(tick) + " is not expected");
    break;
  }
  if (expected.results != trace.results) {
    const size_t num_common = std::min(expected.results.size(), trace.results.size());
    size_t i = 0;
    while (i < num_common && expected.results[i] == trace.results[i]) ++i;
    differences.push_back("result " + std::to_string(i) + ": " + quoted_or_none(trace.results, i) +
                          ", expected " + quoted_or_none(expected.results, i));
  }
  return differences;
}

}  // namespace nao::playback
