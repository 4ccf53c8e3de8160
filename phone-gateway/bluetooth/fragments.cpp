#include "phone-gateway/bluetooth/fragments.h"

#include <algorithm>

namespace nao {
namespace {

/** Bytes under way at most. Chosen: what 100 kbit/s carry in 0.12 s, twice the time of an
 * acknowledgement. */
constexpr size_t kWindowBytes = 1500;
/** Below kNumFragmentNumbers, so that an acknowledgement is unique. */
constexpr size_t kWindowFragments = 100;

}  // namespace

FragmentReader::Result FragmentReader::read(std::string_view value) {
  if (value.empty()) return Result::kFault;
  const auto head = static_cast<uint8_t>(value.front());
  if (value.size() == 1) {
    if ((head & kLastFragment) != 0) return Result::kFault;
    awaited_ = head;
    return Result::kAcknowledgement;
  }
  if ((head & ~kLastFragment) != next_) return Result::kFault;
  if (std::exchange(is_complete_, false)) message_.clear();
  if (message_.size() + value.size() - 1 > max_bytes_) return Result::kFault;
  next_ = static_cast<uint8_t>((next_ + 1) % kNumFragmentNumbers);
  message_ += value.substr(1);
  is_complete_ = (head & kLastFragment) != 0;
  return is_complete_ ? Result::kMessage : Result::kIncomplete;
}

void FragmentWriter::put(std::string message) {
  message_ = std::move(message);
  begin_ = 0;
}

std::optional<std::string> FragmentWriter::next() {
  if (message_.empty() || num_bytes_ >= kWindowBytes || sizes_.size() >= kWindowFragments) {
    return std::nullopt;
  }
  const size_t size = std::min(value_bytes_ - 1, message_.size() - begin_);
  const bool is_last = begin_ + size == message_.size();
  std::string fragment(1, static_cast<char>(num_made_ % kNumFragmentNumbers |
                                            (is_last ? kLastFragment : uint8_t{0})));
  fragment += message_.substr(begin_, size);
  begin_ += size;
  if (is_last) message_.clear();
  ++num_made_;
  sizes_.push_back(fragment.size());
  num_bytes_ += fragment.size();
  return fragment;
}

bool FragmentWriter::acknowledge(uint8_t awaited) {
  const uint64_t first = num_acknowledged() % kNumFragmentNumbers;
  const size_t count = (awaited + kNumFragmentNumbers - first) % kNumFragmentNumbers;
  if (awaited >= kNumFragmentNumbers || count > sizes_.size()) return false;
  for (size_t i = 0; i < count; ++i) {
    num_bytes_ -= sizes_.front();
    sizes_.pop_front();
  }
  return true;
}

}  // namespace nao
