#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "messages/reason_table.h"

namespace nao {

/** A code of the table kReasons. Any other text does not compile. */
class ReasonCode {
 public:
  // NOLINTNEXTLINE(google-explicit-constructor): a Reason is written as {"joint-unknown", {name}}.
  consteval ReasonCode(const char* code) : code_(code) {
    if (find_reason_entry(code) == kReasons.size()) throw "no such code in kReasons";
  }
  constexpr std::string_view text() const { return code_; }

 private:
  std::string_view code_;
};

/** Why a command was refused, interrupted or failed, as data: programs translate the code, and
 * to_sentence() is the only place that makes an English sentence of it. */
struct Reason {
  Reason() = default;
  Reason(ReasonCode reason_code, std::vector<std::string> reason_arguments = {})
      : code(reason_code.text()), arguments(std::move(reason_arguments)) {}

  bool operator==(const Reason&) const = default;
  /** True if there is no reason to give, as for an accepted command. */
  bool empty() const { return code.empty(); }

  /** One of kReasons, or another one from a newer program. */
  std::string code;
  /** In the order of the entry in kReasons. */
  std::vector<std::string> arguments;
};

/** The English sentence of the table with the arguments filled in: "" for no reason, the code
 * itself for one that the table does not have. */
std::string to_sentence(const Reason& reason);

/** Writes code and sentence, for test failures. */
std::ostream& operator<<(std::ostream& stream, const Reason& reason);

/** A sentence of a table with its placeholders replaced: "{0}" by the first argument, and so on. A
 * placeholder without an argument stays as it is. */
std::string fill_in_arguments(std::string_view sentence, const std::vector<std::string>& arguments);

/** A number as an argument: at most six significant digits, "nan" or "inf" if it is not finite. */
std::string to_argument(double value);

}  // namespace nao
