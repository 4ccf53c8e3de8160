#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

namespace nao {

/** Covariance matrix adaptation evolution strategy: minimises a noisy function of some tens of
 * numbers without its derivatives.
 *
 * Source: N. Hansen, "The CMA evolution strategy: a tutorial", arXiv:1604.00772, with its default
 * constants and positive weights. The same seed gives the same search. */
class CmaEs {
 public:
  /** @param start       First mean, (dimension).
   * @param sigma       First standard deviation, in the unit of all coordinates.
   * @param population  Candidates in a generation, at least 4. */
  CmaEs(const Eigen::VectorXd& start, double sigma, int population, uint64_t seed);

  /** Candidates of the next generation, (population) of (dimension). */
  const std::vector<Eigen::VectorXd>& ask();
  /** @param costs  Of the last candidates, in their order; smaller is better. */
  void tell(const std::vector<double>& costs);

  const Eigen::VectorXd& mean() const { return mean_; }
  double sigma() const { return sigma_; }

 private:
  double normal();
  void adapt_covariance(const std::vector<int>& order, const Eigen::VectorXd& old_mean,
                        bool is_steady);

  /** Rates of learning; names as in the tutorial. */
  struct Rates {
    double c_sigma = 0;
    double d_sigma = 0;
    double c_c = 0;
    double c_1 = 0;
    double c_mu = 0;
  };

  std::mt19937_64 random_;
  int population_;
  int generation_ = 0;
  /** Of the best half, falling, sum 1; and how many candidates they are worth. */
  Eigen::VectorXd weights_;
  double mu_effective_ = 0;
  Rates rates_;
  /** Mean length of a vector of (dimension) normal deviates. */
  double expected_length_ = 0;

  Eigen::VectorXd mean_;
  double sigma_;
  Eigen::MatrixXd covariance_;
  /** Its square root: principal axes and standard deviations along them. */
  Eigen::MatrixXd axes_;
  Eigen::VectorXd lengths_;
  Eigen::VectorXd path_sigma_;
  Eigen::VectorXd path_c_;
  std::vector<Eigen::VectorXd> candidates_;
};

}  // namespace nao
