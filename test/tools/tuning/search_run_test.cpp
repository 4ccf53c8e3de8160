#include "tools/tuning/search_run.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <string>

#include "common/error.h"
#include "test/support/temporary_folder.h"
#include "test/tools/tuning/noisy_problem.h"
#include "tools/tuning/workers.h"

namespace nao {
namespace {

class SearchRun : public testing::Test {
 protected:
  SearchOptions options(const std::string& name, int generations = 6) {
    SearchOptions result;
    result.output = (folder_.path() / name).string();
    result.generations = generations;
    result.population = 9;
    result.sigma = 0.3;
    return result;
  }
  void run(const SearchOptions& options, int threads, const NoisyProblem& problem = {}) {
    ThreadEvaluator evaluator(threads, [&](const Task& task) { return problem.run(task); });
    run_search(options, problem, evaluator);
  }
  /** Output and checkpoint. */
  static std::string files(const SearchOptions& options) {
    return read_text(options.output) + "---\n" + read_text(options.checkpoint_file());
  }
  /** Text of the error that a resumed search throws. */
  std::string error_of(const SearchOptions& options) {
    try {
      run(options, 1);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "no error";
  }

  TemporaryFolder folder_;
};

TEST_F(SearchRun, GivesTheSameFilesWithAnyNumberOfThreads) {
  for (int screen : {0, 2}) {
    std::string first;
    for (int threads : {1, 2, 3, 16}) {
      SearchOptions search = options("output");
      search.screen = screen;
      run(search, threads);
      if (first.empty()) first = files(search);
      EXPECT_EQ(files(search), first) << threads << " threads";
    }
  }
}

TEST_F(SearchRun, DependsOnTheSeed) {
  SearchOptions other = options("other");
  other.seed = 2;
  run(options("output"), 2);
  run(other, 2);
  EXPECT_NE(read_text(other.output), read_text(options("output").output));
}

TEST_F(SearchRun, ResumedEqualsUninterrupted) {
  run(options("whole"), 2);
  SearchOptions part = options("part", 4);
  run(part, 1);
  part.generations = 6;
  part.resume = part.checkpoint_file();
  run(part, 3);
  EXPECT_EQ(files(part), files(options("whole")));
}

TEST_F(SearchRun, EndsAfterTheGenerationInWhichItIsInterrupted) {
  run(options("whole", 6), 2);
  for (int signal : {SIGINT, SIGUSR1}) {
    SearchOptions part = options("part", 6);
    std::atomic<int> num_trials = 0;
    NoisyProblem problem;
    // In the third generation: nine candidates with six trials each.
    problem.on_trial = [&](const Task&) {
      if (++num_trials == 2 * 54 + 10) raise(signal);
    };
    run(part, 2, problem);
    EXPECT_EQ(num_trials, 3 * 54);
    part.resume = part.checkpoint_file();
    run(part, 2);
    EXPECT_EQ(files(part), files(options("whole")));
  }
}

TEST_F(SearchRun, WritesTheOutputAgainIfNothingIsLeftToDo) {
  SearchOptions part = options("whole");
  run(part, 2);
  const std::string whole = files(part);
  part.resume = part.checkpoint_file();
  part.output = (folder_.path() / "again").string();
  run(part, 1);
  EXPECT_EQ(files(part), whole);
}

TEST_F(SearchRun, NamesADamagedCheckpoint) {
  SearchOptions search = options("output");
  run(search, 2);
  search.resume = search.checkpoint_file();
  const std::string good = read_text(search.resume);

  write_text(search.resume, good.substr(0, good.size() / 2));
  EXPECT_NE(error_of(search).find("damaged"), std::string::npos) << error_of(search);
  EXPECT_NE(error_of(search).find(search.resume), std::string::npos) << error_of(search);

  // Valid JSON, but a generation is missing.
  const size_t begin = good.find("[[") + 1;
  std::string shorter = good;
  shorter.erase(begin, good.find("],[") + 2 - begin);
  write_text(search.resume, shorter);
  EXPECT_NE(error_of(search).find("do not lead to its mean"), std::string::npos)
      << error_of(search);
}

TEST_F(SearchRun, RefusesTheCheckpointOfAnotherSearch) {
  SearchOptions search = options("output");
  run(search, 2);
  search.resume = search.checkpoint_file();
  search.seed = 3;
  EXPECT_NE(error_of(search).find("--seed is 3"), std::string::npos) << error_of(search);
}

TEST_F(SearchRun, ReportsAFailedTrialAndLeavesTheLastCheckpoint) {
  SearchOptions search = options("output", 2);
  run(search, 2);
  const std::string two = files(search);
  NoisyProblem problem;
  problem.on_trial = [](const Task& task) {
    if (task.trial == 3) throw Error("no such posture");
  };
  search.generations = 3;
  search.resume = search.checkpoint_file();
  EXPECT_THROW(run(search, 2, problem), Error);
  EXPECT_EQ(files(search), two);
}

TEST_F(SearchRun, GivesUpTheWorstThirdAfterTheScreeningTrials) {
  SearchOptions search = options("output", 3);
  search.screen = 2;
  std::atomic<int> num_trials = 0;
  NoisyProblem problem;
  problem.on_trial = [&](const Task&) { ++num_trials; };
  run(search, 2, problem);
  EXPECT_EQ(num_trials, 3 * (9 * 2 + 6 * 4));
}

TEST_F(SearchRun, FindsTheMinimum) {
  SearchOptions search = options("output", 60);
  search.screen = 2;
  run(search, 2);
  double norm = 0;
  std::istringstream lines(read_text(search.output));
  for (std::string line; std::getline(lines, line);) norm += std::pow(std::stod(line), 2);
  EXPECT_LT(norm, 0.02);
}

TEST(Workers, RunOnThreadsWithoutMpirun) {
  const NoisyProblem problem;
  int num_workers = 0;
  with_workers(
      3, "identity", [&](const Task& task) { return problem.run(task); },
      [&](Evaluator& evaluator) { num_workers = evaluator.num_workers(); });
  EXPECT_EQ(num_workers, 3);
}

}  // namespace
}  // namespace nao
