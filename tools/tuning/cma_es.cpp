#include "tools/tuning/cma_es.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace nao {

CmaEs::CmaEs(const Eigen::VectorXd& start, double sigma, int population, uint64_t seed)
    : random_(seed), population_(population), mean_(start), sigma_(sigma) {
  const auto n = static_cast<double>(start.size());
  weights_.resize(population / 2);
  double sum = 0;
  for (int i = 0; i < weights_.size(); ++i) {
    // Recombination weights that fall with the logarithm of the rank; only the better half counts.
    weights_[i] = std::log((population + 1) / 2.0) - std::log(i + 1.0);
    sum += weights_[i];
  }
  double squares = 0;
  for (double& weight : weights_) {
    weight /= sum;
    squares += weight * weight;
  }
  // Variance-effective number of parents: between 1 (one counts) and population / 2 (all count
  // alike).
  const double mu = 1 / squares;
  mu_effective_ = mu;
  // Default learning rates for n parameters; none is meant to be tuned for a problem.
  rates_.c_sigma = (mu + 2) / (n + mu + 5);
  rates_.d_sigma = 1 + 2 * std::max(0.0, std::sqrt((mu - 1) / (n + 1)) - 1) + rates_.c_sigma;
  rates_.c_c = (4 + mu / n) / (n + 4 + 2 * mu / n);
  rates_.c_1 = 2 / ((n + 1.3) * (n + 1.3) + mu);
  rates_.c_mu = std::min(1 - rates_.c_1, 2 * (mu - 2 + 1 / mu) / ((n + 2) * (n + 2) + mu));
  // E|N(0, I)| in n dimensions, series of sqrt(2) Gamma((n + 1) / 2) / Gamma(n / 2).
  expected_length_ = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));
  covariance_.setIdentity(start.size(), start.size());
  path_sigma_.setZero(start.size());
  path_c_.setZero(start.size());
}

double CmaEs::normal() {
  // Box-Muller transform: std::normal_distribution differs between standard libraries.
  const double u = 1 - std::generate_canonical<double, 53>(random_);
  const double v = std::generate_canonical<double, 53>(random_);
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * v);
}

const std::vector<Eigen::VectorXd>& CmaEs::ask() {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance_);
  axes_ = solver.eigenvectors();
  // C = B D^2 B^T: a candidate is m + sigma B D z with z ~ N(0, I). Rounding may make the smallest
  // eigenvalues negative: they are replaced by a tiny positive one.
  lengths_ = solver.eigenvalues().cwiseMax(1e-20).cwiseSqrt();
  candidates_.clear();
  for (int k = 0; k < population_; ++k) {
    Eigen::VectorXd z = lengths_;
    for (double& value : z) value *= normal();
    const Eigen::VectorXd way = axes_ * z;
    candidates_.emplace_back(mean_ + sigma_ * way);
  }
  return candidates_;
}

void CmaEs::tell(const std::vector<double>& costs) {
  ++generation_;
  std::vector<int> order(costs.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return costs[a] < costs[b]; });
  const Eigen::VectorXd old_mean = mean_;
  mean_.setZero();
  // The new mean: weighted mean of the best candidates.
  for (int i = 0; i < weights_.size(); ++i) mean_ += weights_[i] * candidates_[order[i]];

  // Evolution path in coordinates where the candidates' distribution is isotropic: it is long if
  // consecutive steps have similar directions.
  const Eigen::VectorXd step = (mean_ - old_mean) / sigma_;
  const double keep = 1 - rates_.c_sigma;
  const Eigen::VectorXd along = axes_.transpose() * step;
  const Eigen::VectorXd whitened = axes_ * along.cwiseQuotient(lengths_);
  path_sigma_ *= keep;
  path_sigma_ += std::sqrt(rates_.c_sigma * (2 - rates_.c_sigma) * mu_effective_) * whitened;
  // Relative to a random walk's length: above 1 consecutive steps agree and sigma grows; below 1
  // they cancel and it shrinks.
  const double length = path_sigma_.norm() / expected_length_;
  // While the path is much longer than that of a random walk, sigma is still growing fast, and C
  // must not learn the same direction as well.
  const bool is_steady = length / std::sqrt(1 - std::pow(keep, 2 * generation_)) <
                         1.4 + 2.0 / (static_cast<double>(mean_.size()) + 1);
  path_c_ *= 1 - rates_.c_c;
  if (is_steady) path_c_ += std::sqrt(rates_.c_c * (2 - rates_.c_c) * mu_effective_) * step;
  adapt_covariance(order, old_mean, is_steady);
  sigma_ *= std::exp(rates_.c_sigma / rates_.d_sigma * (length - 1));
}

void CmaEs::adapt_covariance(const std::vector<int>& order, const Eigen::VectorXd& old_mean,
                             bool is_steady) {
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(mean_.size(), mean_.size());
  for (int i = 0; i < weights_.size(); ++i) {
    const Eigen::VectorXd y = (candidates_[order[i]] - old_mean) / sigma_;
    const Eigen::VectorXd weighted = weights_[i] * y;
    spread += weighted * y.transpose();
  }
  const Eigen::VectorXd learnt = rates_.c_1 * path_c_;
  const double missing = is_steady ? 0 : rates_.c_1 * rates_.c_c * (2 - rates_.c_c);
  // Rank-one update along the path, rank-mu update with the best candidates; `missing` replaces the
  // variance that a stalled path does not add.
  covariance_ *= 1 - rates_.c_1 - rates_.c_mu + missing;
  covariance_ += learnt * path_c_.transpose();
  covariance_ += rates_.c_mu * spread;
}

}  // namespace nao
