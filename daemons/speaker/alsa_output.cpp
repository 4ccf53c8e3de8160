// Sound by ALSA's library: https://www.alsa-project.org/alsa-doc/alsa-lib/pcm.html
#include <alsa/asoundlib.h>

#include <algorithm>
#include <deque>

#include "common/error.h"
#include "common/logger.h"
#include "daemons/speaker/audio_output.h"

namespace nao::speaker {
namespace {

/** Length of the sound in the device's buffer, microseconds. Chosen: longer than the speaker's
 * lead, so that a pause of the program is not heard. */
constexpr unsigned kBufferTime = 700000;

void ignore_error(const char* /*file*/, int /*line*/, const char* /*function*/, int /*error*/,
                  const char* /*format*/, ...) {}

class AlsaOutput : public AudioOutput {
 public:
  explicit AlsaOutput(const std::string& device) : device_(device) {
    // ALSA reports faults of its configuration on stderr; the exception states the relevant one.
    snd_lib_error_set_handler(ignore_error);
    const int error =
        snd_pcm_open(&pcm_, device.c_str(), SND_PCM_STREAM_PLAYBACK, SND_PCM_NONBLOCK);
    if (error < 0) {
      throw Error("ALSA cannot open the device \"" + device + "\": " + snd_strerror(error));
    }
  }
  ~AlsaOutput() override { snd_pcm_close(pcm_); }
  AlsaOutput(const AlsaOutput&) = delete;
  AlsaOutput& operator=(const AlsaOutput&) = delete;

  void play(const AudioPiece& piece) override {
    if (piece.samples.empty()) {
      waiting_.clear();
      snd_pcm_drop(pcm_);
      sample_rate_ = 0;
      return;
    }
    if (!prepare(piece.sample_rate)) return;
    waiting_.insert(waiting_.end(), piece.samples.begin(), piece.samples.end());
    step();
  }

  void step() override {
    while (!waiting_.empty() && sample_rate_ > 0) {
      std::vector<int16_t> block(waiting_.begin(),
                                 waiting_.begin() + std::min<long>(kBlock, ssize(waiting_)));
      const snd_pcm_sframes_t written = snd_pcm_writei(pcm_, block.data(), block.size());
      if (written == -EAGAIN) return;
      if (written < 0) {
        // An underrun between two texts, or the device was suspended.
        if (snd_pcm_recover(pcm_, static_cast<int>(written), 1) == 0) continue;
        logger::warn("ALSA device {}: {}", device_, snd_strerror(static_cast<int>(written)));
        waiting_.clear();
        return;
      }
      waiting_.erase(waiting_.begin(), waiting_.begin() + written);
      // By itself the device would begin only when its buffer is full, which a short text never
      // achieves.
      if (snd_pcm_state(pcm_) == SND_PCM_STATE_PREPARED) snd_pcm_start(pcm_);
    }
  }

 private:
  /** Samples that are handed to the device at once. Chosen: copied in microseconds. */
  static constexpr long kBlock = 1024;

  static long ssize(const std::deque<int16_t>& samples) {
    return static_cast<long>(samples.size());
  }

  /** @return false if the device does not play at this rate. */
  bool prepare(int sample_rate) {
    if (sample_rate == sample_rate_) return true;
    const int error = snd_pcm_set_params(pcm_, SND_PCM_FORMAT_S16, SND_PCM_ACCESS_RW_INTERLEAVED, 1,
                                         static_cast<unsigned>(sample_rate), 1, kBufferTime);
    sample_rate_ = error < 0 ? 0 : sample_rate;
    if (error < 0) logger::warn("ALSA device {}: {}", device_, snd_strerror(error));
    return error >= 0;
  }

  std::string device_;
  snd_pcm_t* pcm_ = nullptr;
  /** Sample rate for which the device is prepared; 0 if it is not. */
  int sample_rate_ = 0;
  std::deque<int16_t> waiting_;
};

}  // namespace

std::unique_ptr<AudioOutput> open_alsa(const std::string& device) {
  return std::make_unique<AlsaOutput>(device);
}

}  // namespace nao::speaker
