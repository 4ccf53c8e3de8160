#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

namespace nao {

/** Covariance matrix adaptation evolution strategy (CMA-ES): minimizes a noisy function of some
 * tens of variables without derivatives.
 *
 * Source: N. Hansen, "The CMA evolution strategy: a tutorial", arXiv:1604.00772, with its default
 * constants and positive weights. The same seed gives the same search. Not Debian's pagmo, whose
 * cmaes evolves a whole population in one call, algorithm.evolve(population): checkpoints and
 * evaluation on several hosts need ask and tell. */
class CmaEs {
 public:
  /** @param start       First mean, (dimension).
   * @param sigma       First standard deviation, in the unit of all coordinates.
   * @param population  Candidates in a generation, at least 4. */
  CmaEs(const Eigen::VectorXd& start, double sigma, int population, uint64_t seed);

  /** Candidates of the next generation, (population) of (dimension). With tell(), this is the
   * ask-and-tell interface of Hansen's implementations. */
  const std::vector<Eigen::VectorXd>& ask();
  /** @param costs  Costs of the last candidates, in their order; smaller is better. */
  void tell(const std::vector<double>& costs);

  const Eigen::VectorXd& mean() const { return mean_; }
  double sigma() const { return sigma_; }

 private:
  double normal();
  void adapt_covariance(const std::vector<int>& order, const Eigen::VectorXd& old_mean,
                        bool is_steady);

  /** Learning rates; names as in the tutorial. */
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
  /** Recombination weights of the best half, decreasing, with sum 1; and their effective selection
   * mass mu_eff. */
  Eigen::VectorXd weights_;
  double mu_effective_ = 0;
  Rates rates_;
  /** Expected norm of a standard normal vector of (dimension). */
  double expected_length_ = 0;

  Eigen::VectorXd mean_;
  double sigma_;
  Eigen::MatrixXd covariance_;
  /** Eigendecomposition of the covariance: principal axes and standard deviations along them. */
  Eigen::MatrixXd axes_;
  Eigen::VectorXd lengths_;
  Eigen::VectorXd path_sigma_;
  Eigen::VectorXd path_c_;
  std::vector<Eigen::VectorXd> candidates_;
};

}  // namespace nao
