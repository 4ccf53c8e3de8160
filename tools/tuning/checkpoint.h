#pragma once

#include <map>
#include <string>
#include <vector>

namespace nao {

/** Data with which a search continues after an interruption: the costs of all candidates so far.
 * The search is a function of its settings and these costs, so repeating it with them needs no
 * trial and leads to the same state bit for bit.
 *
 * As a text: one JSON object with `settings`, `costs` (a list for each generation) and `mean`. */
struct Checkpoint {
  /** Everything else on which the search depends, by name, such as "population". */
  std::map<std::string, std::string> settings{};
  /** Costs of each generation's candidates. */
  std::vector<std::vector<double>> costs{};
  /** Mean of the search after the last of these generations, to recognize damage. */
  std::vector<double> mean{};

  bool operator==(const Checkpoint&) const = default;

  std::string to_text() const;
  /** @param name  Name of the file, for errors.
   * @throws ConfigError  if the text is not a checkpoint. */
  static Checkpoint parse(const std::string& text, const std::string& name);

  /** @throws ConfigError  that names the settings which differ from those of the present search. */
  void require_settings(const std::map<std::string, std::string>& present,
                        const std::string& name) const;
};

}  // namespace nao
