#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>

#include "common/error.h"
#include "common/processor_time.h"
#include "policy/policy_network.h"

namespace nao {
namespace {

/** The beginning of a text, at most 300 characters, without line breaks. */
std::string on_one_line(std::string text) {
  text = text.substr(0, 300);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// OpenCV has no common name for its own and its libraries' errors: what a damaged file causes may
// be any exception.
class OpenCvNetwork : public PolicyNetwork {
 public:
  OpenCvNetwork(const std::filesystem::path& file, int num_observations)
      : input_(1, num_observations, CV_32F) {
    // What is wrong with a file goes into the exception, not to the terminal.
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    // Another thread costs a small network more than it saves, and would not be a real-time one.
    cv::setNumThreads(1);
    net_ = cv::dnn::readNetFromONNX(file.string());
    net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    net_.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  }

  /** Inputs of the first fully connected layer; 0 without one. OpenCV does not tell the shape of
   * the network's input. */
  int find_num_inputs() {
    for (const cv::String& name : net_.getLayerNames()) {
      const cv::Ptr<cv::dnn::Layer> layer = net_.getLayer(net_.getLayerId(name));
      if (layer->blobs.empty()) continue;
      const cv::Mat& weights = layer->blobs[0];
      if (layer->type == "InnerProduct") return weights.cols;
      // OpenCV 4.9 and later, which does not tell whether the weights are transposed.
      if (layer->type == "Gemm") return takes(weights.cols) ? weights.cols : weights.rows;
    }
    return 0;
  }

  bool takes(int num_inputs) {
    try {
      net_.setInput(cv::Mat::zeros(1, num_inputs, CV_32F));
      net_.forward();
      return true;
    } catch (const cv::Exception&) {
      return false;
    }
  }

  bool has_memory() {
    for (const cv::String& name : net_.getLayerNames()) {
      const cv::String type = net_.getLayer(net_.getLayerId(name))->type;
      if (type == "LSTM" || type == "GRU" || type == "RNN") return true;
    }
    return false;
  }

  double run(const std::vector<float>& observation, std::vector<float>& action) override {
    // How busy a machine is must not change what a run in lock-step does.
    const double begin = thread_seconds();
    std::copy(observation.begin(), observation.end(), input_.ptr<float>());
    net_.setInput(input_);
    const cv::Mat output = net_.forward();
    const auto* numbers = output.ptr<float>();
    action.assign(numbers, numbers + output.total());
    return thread_seconds() - begin;
  }

 private:
  cv::Mat input_;
  cv::dnn::Net net_;
};

}  // namespace

std::unique_ptr<PolicyNetwork> load_policy_network(const std::filesystem::path& file,
                                                   int num_observations, int num_actions) {
  if (!std::filesystem::is_regular_file(file)) throw ModelError(file.string() + ": is missing");
  const std::string name = file.string();
  int num_inputs = 0;
  std::vector<float> action;
  std::unique_ptr<OpenCvNetwork> network;
  try {
    network = std::make_unique<OpenCvNetwork>(file, num_observations);
    if (network->has_memory()) {
      throw ModelError(name +
                       ": has a layer with memory (LSTM, GRU); only networks without are run");
    }
    num_inputs = network->find_num_inputs();
    network->run(std::vector<float>(static_cast<size_t>(num_observations)), action);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    if (num_inputs > 0 && num_inputs != num_observations) {
      throw ModelError(fmt::format("{}: has {} inputs, but the manifest lists {} observations",
                                   name, num_inputs, num_observations));
    }
    throw ModelError(fmt::format(
        "{}: OpenCV {} cannot run it; export fully connected layers with ELU, ReLU, SiLU or Tanh, "
        "without layer normalization and clamp: {}",
        name, CV_VERSION, on_one_line(error.what())));
  }
  if (action.size() != static_cast<size_t>(num_actions)) {
    throw ModelError(fmt::format("{}: has {} outputs, but the manifest lists {} joints", name,
                                 action.size(), num_actions));
  }
  return network;
}

}  // namespace nao
